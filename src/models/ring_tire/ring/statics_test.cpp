// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "models/ring_tire/description/ring_parameters_testing.h"
#include "models/ring_tire/ring/ring_tire.h"
#include "models/road/drum_road.h"
#include "models/road/plane_road.h"
#include "models/road/profile_road.h"

namespace latsch::ring_tire {
namespace {

/// Returns a ring that has 960 blocks per line for any number of segments: only the belt is
/// refined, not the tread.
RingParameters ring_of(int nodes) {
  RingParameters ring = passenger_ring();
  ring.nodes = nodes;
  ring.tread.blocks = 960 / nodes;
  return ring;
}

WheelMotion pressed(const RingTire& tire, double depth, double camber = 0.0) {
  WheelMotion motion;
  motion.center.z() = tire.free_radius() - depth;
  motion.carrier = Eigen::AngleAxisd(camber, Eigen::Vector3d::UnitX()).toRotationMatrix();
  return motion;
}

double load(const RingParameters& ring, double depth, const road::Road& road, double spin = 0.0) {
  RingTire tire(ring);
  WheelMotion motion = pressed(tire, depth);
  motion.spin = spin;
  const auto hub = tire.settle(motion, road, 0.0);
  EXPECT_TRUE(hub) << ring.nodes << " segments: " << hub.failure().reason;
  return hub ? hub->force.z() : 0.0;
}

/// Returns the mean of two loads: with a knot of the belt below the axle, and with the middle of a
/// segment below it.
double mean_load(int nodes) {
  const RingParameters ring = ring_of(nodes);
  double sum = 0.0;
  for (const double spin : {0.0, std::numbers::pi / nodes})
    sum += 0.5 * load(ring, 0.022, road::PlaneRoad(), spin);
  return sum;
}

// The errors of bending, extension and pressure of the belt's curve are of fourth order in the
// length of its segments. The pressure has a kink at the end of the contact patch.
TEST(RingStatics, LoadConvergesWithTheSegments) {
  const double F40 = mean_load(40), F80 = mean_load(80), F160 = mean_load(160);
  EXPECT_GT(std::log2((F40 - F80) / (F80 - F160)), 3.0);
  const double F320 = load(ring_of(320), 0.022, road::PlaneRoad());
  EXPECT_NEAR(F80, F320, 3e-4 * F320);
  for (int nodes : {60, 64, 96, 128, 240})
    EXPECT_NEAR(load(ring_of(nodes), 0.022, road::PlaneRoad()), F320, 1e-3 * F320) << nodes;
}

// Loads range from those at which a few blocks touch to one that presses the belt nearly to the
// rim.
TEST(RingStatics, StandsOnEveryRoadUnderEveryLoad) {
  road::DrumRoad::Settings drum{.diameter = 2.0};
  const road::DrumRoad smooth(drum);
  drum.cleats = {{.profile = road::cleat_profile(0.015, 0.03, 0.005), .angle = 0.5}};
  const road::DrumRoad oblique(drum);
  const road::PlaneRoad plane;
  const road::ProfileRoad cleat = road::cleat_road(0.0, 0.02, 0.02, 0.0005);
  for (const road::Road* road :
       std::initializer_list<const road::Road*>{&plane, &smooth, &oblique, &cleat})
    for (int nodes : {48, 96, 160, 320})
      for (double depth : {1e-4, 0.005, 0.02, 0.06}) {
        RingTire tire(ring_of(nodes));
        const auto hub = tire.settle(pressed(tire, depth, 0.03), *road, 0.0);
        ASSERT_TRUE(hub) << nodes << " segments, " << depth << " m: " << hub.failure().reason;
      }
}

// The elements of the sidewall that have a memory are included. The residual forces at the nodes
// have a norm of at most 1 mN, so their sum is at most sqrt(160) times that.
TEST(RingStatics, BalancesToTheTolerance) {
  RingParameters ring = ring_of(160);
  ring.sidewall.radial.friction_stiffening = 0.1;
  ring.sidewall.radial.friction_force = 500.0;
  ring.sidewall.progressivity = 1.2;
  RingTire tire(ring);
  const auto hub = tire.settle(pressed(tire, 0.025), road::PlaneRoad(), 0.0);
  ASSERT_TRUE(hub) << hub.failure().reason;
  Eigen::Vector3d ground = Eigen::Vector3d::Zero();
  for (const BlockContact& block : tire.contacts()) ground += block.force;
  EXPECT_LT((hub->force - ground).norm(), 0.013);
}

}  // namespace
}  // namespace latsch::ring_tire
