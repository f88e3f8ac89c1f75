// SPDX-License-Identifier: Apache-2.0
// Tests a tire whose tread bottoms out (37): conservation of energy, and hard impacts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "models/ring_tire/description/ring_parameters_testing.h"
#include "models/ring_tire/ring/motion_slopes_testing.h"
#include "models/ring_tire/ring/ring_tire.h"
#include "models/road/plane_road.h"
#include "models/road/profile_road.h"

namespace latsch::ring_tire {
namespace {

RingParameters bottoming_ring(double bottoming) {
  RingParameters ring = passenger_ring();
  ring.nodes = 60;
  ring.tread.blocks = 8;
  ring.tread.height = 0.008;
  ring.tread.bottoming = bottoming;
  return ring;
}

/// Energy balance of a run, J, in which a tire without losses and friction rolls while its hub
/// moves up and down. `most` is the largest increase of the energy, in the tire and at the road,
/// beyond the work of the rim; `work` is this work.
struct EnergyDrift {
  double most = 0.0, work = 0.0;
};
EnergyDrift heaving(double bottoming, double h) {
  RingParameters ring = bottoming_ring(bottoming);
  TreadFriction& mu = ring.tread.friction;
  mu.adhesion = mu.maximum = mu.sliding = mu.blocking = {0.0, 0.0, 0.0};
  ring.sidewall.torsion_damping = 0.0;
  for (SidewallElement* e :
       {&ring.sidewall.radial, &ring.sidewall.tangential, &ring.sidewall.lateral})
    *e = {.stiffness = e->stiffness};
  RingSettings settings = kUntilRounding;
  settings.dissipation = 0.0;
  RingTire tire(ring, settings);
  const road::PlaneRoad road;
  const double height = tire.free_radius() - 0.02;
  constexpr double kSpeed = 15.0, kOmega = 2.0 * std::numbers::pi * 30.0;
  const auto at = [&](double time) {
    WheelMotion motion;
    motion.center = {kSpeed * time, 0.0, height - 0.006 * (1.0 - std::cos(kOmega * time))};
    motion.velocity = {kSpeed, 0.0, -0.006 * kOmega * std::sin(kOmega * time)};
    motion.spin_rate = kSpeed / 0.303;
    motion.spin = motion.spin_rate * time;
    return motion;
  };
  EXPECT_TRUE(tire.settle(at(0.0), road, 0.0));
  EnergyDrift drift;
  double power = 0.0, balance = 0.0;
  for (int i = 1; i <= std::lround(0.03 / h); ++i) {
    const WheelMotion motion = at(i * h);
    const auto hub = tire.advance(motion, road, i * h, h);
    EXPECT_TRUE(hub);
    if (!hub) break;
    const double now = -hub->force.dot(motion.velocity) - hub->moment.y() * motion.spin_rate;
    if (i == 1) {
      balance = tire.energy();
    } else {
      balance += 0.5 * h * (power + now);
      drift.work += 0.5 * h * std::abs(power + now);
      drift.most = std::max(drift.most, std::abs(tire.energy() - balance));
    }
    power = now;
  }
  return drift;
}

// The energy of the compressed blocks (37) must match their forces: the balance includes the energy
// exchanged with the road. The remaining error falls with the square of the step, as it does with
// linear rubber.
TEST(TreadBottoming, RollingWithoutLossesKeepsItsEnergy) {
  for (const double bottoming : {0.0, 1.0, 0.35}) {
    const EnergyDrift wide = heaving(bottoming, 2e-4), narrow = heaving(bottoming, 5e-5);
    ASSERT_GT(narrow.work, 20.0);
    EXPECT_LT(narrow.most, 1e-4 * narrow.work) << bottoming;
    EXPECT_GT(wide.most, 8.0 * narrow.most) << bottoming;
  }
}

/// Returns the largest compression of a tread block, m, when the tire hits a plank 50 mm high at 60
/// m/s.
double deepest_at_a_plank(double bottoming) {
  RingParameters ring = bottoming_ring(bottoming);
  ring.tread.damping_time = 1e-4;
  ring.sidewall.rim_travel = 0.06;
  ring.sidewall.rim_stiffness = 5e6;
  RingTire tire(ring);
  const road::ProfileRoad road = road::cleat_road(0.7, 0.05, 0.3, 0.015);
  WheelMotion motion;
  motion.center.z() = tire.free_radius() - 0.03;
  motion.velocity.x() = 60.0;
  motion.spin_rate = 60.0 / 0.3055;
  EXPECT_TRUE(tire.settle(motion, road, 0.0));
  constexpr double h = 2e-4;
  double deepest = 0.0;
  for (int i = 1; i <= 70; ++i) {
    motion.center += h * motion.velocity;
    motion.spin += h * motion.spin_rate;
    const auto hub = tire.advance(motion, road, i * h, h);
    EXPECT_TRUE(hub) << hub.failure().reason;
    if (!hub) break;
    for (const BlockContact& block : tire.contacts())
      deepest = std::max(deepest, (block.root - block.unloaded).norm());
  }
  return deepest;
}

TEST(TreadBottoming, AHardHitDoesNotPressItToNothing) {
  const double height = bottoming_ring(0.0).tread.height;
  EXPECT_GT(deepest_at_a_plank(0.0), height);
  for (const double bottoming : {1.0, 0.35})
    EXPECT_LT(deepest_at_a_plank(bottoming), bottoming * height) << bottoming;
}

// A tread under little pressure must behave like linear rubber. Under a load it must be stiffer,
// the more so the earlier it bottoms out.
TEST(TreadBottoming, BarelyPressedItIsLinear) {
  const auto standing_load = [](double bottoming, double sink) {
    RingTire tire(bottoming_ring(bottoming));
    WheelMotion motion;
    motion.center.z() = tire.free_radius() - sink;
    const auto hub = tire.settle(motion, road::PlaneRoad(), 0.0);
    EXPECT_TRUE(hub);
    return hub->force.z();
  };
  EXPECT_NEAR(standing_load(1.0, 1e-4) / standing_load(0.0, 1e-4), 1.0, 0.01);
  const double linear = standing_load(0.0, 0.02);
  EXPECT_GT(standing_load(1.0, 0.02), linear);
  EXPECT_GT(standing_load(0.35, 0.02), standing_load(1.0, 0.02));
}

}  // namespace
}  // namespace latsch::ring_tire
