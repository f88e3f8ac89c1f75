// SPDX-License-Identifier: Apache-2.0
// Tests of the standing finite-element tire: closed forms if the whole patch slides, equalities if
// two paths lead to the same state.
#include "experiment/rigs/fe_tire/standing_rig.h"

#include <gtest/gtest.h>

#include <numbers>

#include "experiment/rigs/fe_tire/deflection_for_load.h"
#include "models/fe_tire/description/reference_tires.h"

namespace latsch::experiment {
namespace {

using fe_tire::FeTire;
using fe_tire::Ground;
using fe_tire::GroundPose;

constexpr double kInflation = 2.6e5;

FeTire small_tire(int sectors = 40) {
  fe_tire::TireDescription tire = fe_tire::reference_tire_b();
  tire.section.meridional = 13;
  tire.section.sectors = sectors;
  return FeTire(tire);
}

double value(const Channels& channels, const char* name) { return channels[name].at(0); }

Channels stand_under_load(FeTire& tire, std::vector<Direction> directions, double camber = 0.0) {
  const auto channels = stand(
      tire,
      kInflation,
      {.load = 3000.0, .directions = std::move(directions), .camber = camber, .friction = 0.9});
  EXPECT_TRUE(channels) << channels.failure().reason;
  return *channels;
}

TEST(StandingFeTire, PulledFarItSlidesAtTheLimitOfFriction) {
  FeTire tire = small_tire();
  const auto inflated = tire.inflate(kInflation);
  ASSERT_TRUE(inflated);
  const auto start = tire.over(*inflated, Ground{.mu = 0.5}, FeTire::Poses::any);
  GroundPose pose = FeTire::below(*inflated, 0.01);
  std::vector<GroundPose> way = {pose};
  for (int k = 1; k <= 8; ++k) {
    pose.y = -0.004 * k;
    way.push_back(pose);
  }
  const auto states = tire.advance(start, way);
  ASSERT_TRUE(states) << states.failure().reason;
  double before = 0.0;
  for (const auto& state : *states) {
    const auto standing = tire.stand(state);
    const double pull = -standing.force.y();
    EXPECT_LE(pull, 0.5 * standing.force.z() * (1.0 + 1e-9));
    EXPECT_GE(pull, before - 0.02 * standing.force.z());
    before = pull;
  }
  const auto last = tire.stand(states->back());
  EXPECT_NEAR(-last.force.y(), 0.5 * last.force.z(), 1e-6 * last.force.z());
}

TEST(StandingFeTire, BothSidesAreAlikeAndTurningDoesNotNeedTheWholeRing) {
  FeTire tire = small_tire();
  const auto inflated = tire.inflate(kInflation);
  ASSERT_TRUE(inflated);
  const Ground ground{.mu = 0.9};
  std::vector<double> moments, forces;
  for (const FeTire::Poses poses : {FeTire::Poses::below, FeTire::Poses::any}) {
    GroundPose pose = FeTire::below(*inflated, 0.01), turned = pose;
    turned.yaw = -0.01;
    const auto states = tire.advance(tire.over(*inflated, ground, poses), {pose, turned});
    ASSERT_TRUE(states) << states.failure().reason;
    moments.push_back(tire.stand(states->back()).moment.z());
    if (poses == FeTire::Poses::below) continue;
    for (const double side : {-1.0, 1.0}) {
      GroundPose moved = pose;
      moved.y = side * 2e-3;
      const auto pulled = tire.advance(states->front(), {moved});
      ASSERT_TRUE(pulled) << pulled.failure().reason;
      forces.push_back(tire.stand(pulled->front()).force.y());
    }
  }
  EXPECT_NEAR(moments[0], moments[1], 1e-5 * std::abs(moments[1]));
  EXPECT_NEAR(forces[0], -forces[1], 1e-5 * std::abs(forces[1]));
}

TEST(StandingFeTire, StiffnessesAreOfTheSizeOfATires) {
  FeTire tire = small_tire();
  const Channels upright = stand_under_load(
      tire,
      {Direction::vertical, Direction::longitudinal, Direction::lateral, Direction::torsional});
  // The stiffness is between half of the vertical stiffness and all of it, as measured on passenger
  // tires.
  const double vertical = value(upright, "vertical");
  EXPECT_GT(value(upright, "lateral"), 0.25 * vertical);
  EXPECT_LT(value(upright, "lateral"), vertical);
  EXPECT_GT(value(upright, "longitudinal"), value(upright, "lateral"));
  EXPECT_GT(value(upright, "torsional"), 0.0);
  // Both signs of camber give equal results except for the plies, which the mirror image reverses.
  const Channels left = stand_under_load(tire, {Direction::vertical}, 0.05);
  const Channels right = stand_under_load(tire, {Direction::vertical}, -0.05);
  EXPECT_NEAR(value(left, "vertical"), value(right, "vertical"), 1e-4 * vertical);
  EXPECT_NE(value(left, "vertical"), vertical);
}

// Only one of 40 rows of nodes is in contact, so a bar below it is equivalent to level ground.
TEST(StandingFeTire, APlankLongerThanThePatchIsGroundThatIsHigher) {
  FeTire tire = small_tire(120);
  const std::vector<double> deflections = {0.004, 0.012};
  const auto flat = stand(tire, kInflation, {.deflections = deflections});
  const auto plank = stand(
      tire,
      kInflation,
      {.deflections = deflections, .cleat = Cleat{.height = 0.02, .length = 0.5, .bevel = 0.005}});
  const auto bar = stand(
      tire,
      kInflation,
      {.deflections = deflections, .cleat = Cleat{.height = 0.02, .length = 0.03, .bevel = 0.005}});
  ASSERT_TRUE(flat && plank && bar);
  for (std::size_t k = 0; k < deflections.size(); ++k) {
    const double Fz = (*flat)["force"][k];
    EXPECT_NEAR((*plank)["force"][k], Fz, 1e-6 * Fz);
    EXPECT_LT((*bar)["force"][k], 0.995 * Fz);
    EXPECT_GT((*bar)["force"][k], 0.3 * Fz);
  }
}

TEST(StandingFeTire, WithoutFrictionItIsNotPulled) {
  FeTire tire = small_tire();
  EXPECT_THROW(stand(tire, kInflation, {.load = 3000.0, .directions = {Direction::lateral}}),
               InputError);
}

}  // namespace
}  // namespace latsch::experiment
