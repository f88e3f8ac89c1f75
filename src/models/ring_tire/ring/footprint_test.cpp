// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "models/ring_tire/description/ring_parameters_testing.h"
#include "models/ring_tire/ring/ring_tire.h"
#include "models/road/plane_road.h"

namespace latsch::ring_tire {
namespace {

Footprint standing_footprint(const RingParameters& ring, double depth, double heading = 0.0) {
  RingTire tire(ring);
  WheelMotion motion;
  motion.center = {3.0, -2.0, tire.free_radius() - depth};
  motion.carrier = Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const auto hub = tire.settle(motion, road::PlaneRoad(), 0.0);
  EXPECT_TRUE(hub) << hub.failure().reason;
  const auto print = tire.footprint();
  EXPECT_NEAR(print->load, hub->force.z(), 0.02);
  return *print;
}

/// Returns a ring whose belt and sidewall deform by less than a thousandth of the rubber's
/// compression. The tread blocks are then on a rigid wheel with a radius of 316 mm and a crown
/// radius of 600 mm.
RingParameters rigid_wheel() {
  RingParameters ring = passenger_ring();
  ring.belt.extension = 1e9;
  ring.sidewall.radial.stiffness = ring.sidewall.tangential.stiffness = 1e10;
  ring.sidewall.lateral.stiffness = 1e10;
  ring.sidewall.torsion = 1e9;
  ring.tread.lines = 40;
  ring.tread.blocks = 20;
  ring.tread.crown_radius = 0.6;
  return ring;
}

// The depth of penetration is δ - x²/2R - y²/2R', so the footprint is an ellipse. Blocks are 1.2 mm
// long, and lines of blocks are 4 mm wide. The outline is linear between them, which shortens an
// arc by an eighth of their square over R δ.
TEST(RingFootprint, OfARigidWheelIsAnEllipse) {
  const double R = 0.316, crown = 0.6, depth = 0.003;
  const Footprint print = standing_footprint(rigid_wheel(), depth);
  const double a = std::sqrt(2.0 * R * depth), b = std::sqrt(2.0 * crown * depth);
  EXPECT_NEAR(print.length, 2.0 * a, 0.01 * a);
  EXPECT_NEAR(print.width, 2.0 * b, 0.01 * b);
  EXPECT_NEAR(print.area, std::numbers::pi * a * b, 0.01 * a * b * std::numbers::pi);
}

// The forces on all elements of the footprint must add up to the load, and their positions must lie
// in the patch below the axle.
TEST(RingFootprint, CarriesTheLoadBelowTheAxle) {
  const Footprint print = standing_footprint(passenger_ring(), 0.02);
  double load = 0.0, x = 0.0, y = 0.0;
  for (const FootprintElement& at : print.elements) {
    const double F = at.pressure * at.length * at.width;
    load += F;
    x += F * at.x;
    y += F * at.y;
  }
  EXPECT_NEAR(load, print.load, 1e-9 * load);
  EXPECT_NEAR(print.mean_pressure() * print.area, load, 1e-9 * load);
  EXPECT_NEAR(x / load, 0.0, 1e-4);
  EXPECT_NEAR(y / load, 0.0, 1e-6);
  EXPECT_NEAR(print.width, 0.16, 1e-9);
}

// If the load grows by one percent, the outline must move by about as much, and never by the length
// of a block, 2.4 mm.
TEST(RingFootprint, GrowsSmoothlyWithTheDeflection) {
  double last = standing_footprint(passenger_ring(), 0.0195).length;
  for (const double depth : {0.0197, 0.0199, 0.0201, 0.0203, 0.0205}) {
    const double length = standing_footprint(passenger_ring(), depth).length;
    EXPECT_GT(length, last) << depth;
    EXPECT_LT(length - last, 0.0025) << depth;
    last = length;
  }
}

// Length is measured along the heading of the wheel, so it must not depend on this heading.
TEST(RingFootprint, TurnsWithTheWheel) {
  const Footprint ahead = standing_footprint(passenger_ring(), 0.02),
                  aside = standing_footprint(passenger_ring(), 0.02, 1.2);
  EXPECT_NEAR(aside.length, ahead.length, 1e-6);
  EXPECT_NEAR(aside.width, ahead.width, 1e-6);
}

}  // namespace
}  // namespace latsch::ring_tire
