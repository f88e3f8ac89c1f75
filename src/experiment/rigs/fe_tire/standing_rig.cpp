// SPDX-License-Identifier: Apache-2.0
// The finite-element tire standing (static_stiffness.h): equilibria, one after the other.
#include <cmath>

#include "experiment/rigs/fe_tire/deflection_for_load.h"
#include "experiment/rigs/static_stiffness.h"

namespace latsch::experiment {
namespace {

using fe_tire::FeTire;
using fe_tire::GroundPose;
using fe_tire::TireState;

constexpr double kTypicalStiffness = 2.0e5;  // N/m, for a first guess of the deflection
constexpr int kSteps = 4;                    // of the ground's way: the patch slides on the way

/// The wheel goes by `travel` in a direction: the ground goes back.
GroundPose moved(GroundPose pose, Direction direction, double travel) {
  switch (direction) {
    case Direction::vertical:
      pose.height -= travel;
      break;
    case Direction::longitudinal:
      pose.x -= travel;
      break;
    case Direction::lateral:
      pose.y -= travel;
      break;
    case Direction::torsional:
      pose.yaw -= travel;
      break;
  }
  return pose;
}

double reaction(const fe_tire::Standing& standing, Direction direction) {
  switch (direction) {
    case Direction::vertical:
      return -standing.force.z();
    case Direction::longitudinal:
      return standing.force.x();
    case Direction::lateral:
      return standing.force.y();
    case Direction::torsional:
      break;
  }
  return standing.moment.z();
}

Result<double> stiffness(FeTire& tire, const TireState& start, Direction direction, double travel) {
  // Without friction up and down are one path; with it only down goes on from the load.
  const bool both_ways = direction == Direction::vertical && start.ground.mu == 0.0;
  const double from = both_ways ? -travel : 0.0;
  std::vector<GroundPose> poses;
  for (int k = both_ways ? 0 : 1; k <= kSteps; ++k) {
    poses.push_back(moved(start.pose, direction, from + (travel - from) * k / kSteps));
  }
  const auto states = tire.advance(start, poses);
  if (!states) return states.failure();
  const TireState& first = both_ways ? states->front() : start;
  const double before = reaction(tire.stand(first), direction);
  return (before - reaction(tire.stand(states->back()), direction)) / (travel - from);
}

fe_tire::Ground ground_of(const StandingTest& test) {
  fe_tire::Ground ground;
  ground.mu = test.friction.value_or(0.0);
  if (test.cleat) {
    ground.bar = fe_tire::Bar{.height = test.cleat->height,
                              .length = test.cleat->length,
                              .bevel = test.cleat->bevel,
                              .angle = test.cleat->angle};
  }
  return ground;
}

}  // namespace

Result<Channels> stand(FeTire& tire, double own_pressure, const StandingTest& test) {
  const fe_tire::Ground ground = ground_of(test);
  bool sideways = false;
  for (const Direction direction : test.directions)
    sideways = sideways || direction != Direction::vertical;
  if (sideways && ground.mu == 0.0)
    throw InputError(
        "a finite-element tire has the friction of its test, and without it slides away: expected "
        "friction = 0.8 or so beside longitudinal, lateral or torsional");
  const auto inflated = tire.inflate(test.pressure.value_or(own_pressure));
  if (!inflated) return inflated.failure();

  std::vector<double> forces, stiffnesses;
  for (const double deflection : test.deflections) {
    std::vector<GroundPose> poses;
    for (int k = 1; k <= kSteps; ++k) {
      poses.push_back(FeTire::below(*inflated, deflection * k / kSteps));
      if (test.cleat) poses.back().height += test.cleat->height;
    }
    TireState start = tire.over(*inflated, ground);
    if (test.cleat) start.pose.height += test.cleat->height;
    const auto states = tire.advance(start, poses);
    if (!states) return states.failure();
    forces.push_back(tire.stand(states->back()).force.z());
  }
  if (test.directions.empty()) return standing_channels(test, forces, stiffnesses);

  StandingPose pose{.camber = test.camber};
  if (sideways || test.camber != 0.0) pose.poses = FeTire::Poses::any;
  const auto loaded =
      load_to_force(tire, *inflated, test.load, test.load / kTypicalStiffness, ground, pose);
  if (!loaded) return loaded.failure();
  for (const Direction direction : test.directions) {
    const double travel = direction == Direction::torsional ? test.twist : test.travel;
    const auto found = stiffness(tire, *loaded, direction, travel);
    if (!found) return found.failure();
    stiffnesses.push_back(*found);
  }
  return standing_channels(test, forces, stiffnesses);
}

}  // namespace latsch::experiment
