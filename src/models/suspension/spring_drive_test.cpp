// SPDX-License-Identifier: Apache-2.0
#include "models/suspension/spring_drive.h"

#include <gtest/gtest.h>

#include "models/suspension/geometry_testing.h"

namespace latsch::suspension {
namespace {

using Eigen::Vector3d;

SpringState state_of(const CornerGeometry& corner, double travel, double rack) {
  MovingLinkage moving(corner.linkage, TravelOf::contact);
  EXPECT_TRUE(moving.move_to(travel, rack));
  const auto state =
      spring_state(corner.spring, corner.linkage.wheel.center, moving.upright(), moving.twists());
  EXPECT_TRUE(state) << state.failure().reason;
  return *state;
}

// The upright only translates on a circle, so the length of the spring is the distance between two
// known points.
TEST(SpringDrive, WithoutARockerIsTheDistanceOfItsEnds) {
  const CornerGeometry corner = parallelogram();
  ASSERT_EQ(corner.spring.fault(), "");
  for (const double travel : {0.0, 0.05, -0.1}) {
    const double y = std::sqrt(kArm * kArm - travel * travel) - kArm, z = 0.5 - travel;
    const SpringState state = state_of(corner, travel, 0.0);
    EXPECT_NEAR(state.length, std::hypot(y, z), 1e-12);
    EXPECT_NEAR(state.length_slopes[0], (-travel / (y + kArm) * y - z) / std::hypot(y, z), 1e-12);
  }
}

// A point of a wishbone moves on a circle about the wishbone's axis. It turns by the same angle as
// the ball joint.
TEST(SpringDrive, OnAWishboneFollowsItsAngle) {
  CornerGeometry corner = parallelogram();
  corner.spring.on = SpringDrive::On::lower_wishbone;
  corner.spring.hinge_front = corner.linkage.links[2].inner;
  corner.spring.hinge_rear = corner.linkage.links[3].inner;
  corner.spring.ball = corner.linkage.links[2].outer;
  corner.spring.outer = {0.02, 0.45, 0.2};  // in the middle of the wishbone's arm
  corner.spring.inner = {0.02, 0.40, 0.6};
  const double travel = 0.08, angle = std::asin(travel / kArm);
  const Vector3d end(0.02, 0.3 + 0.5 * kArm * std::cos(angle), 0.2 + 0.5 * kArm * std::sin(angle));
  EXPECT_NEAR(state_of(corner, travel, 0.0).length, (end - corner.spring.inner).norm(), 1e-12);
}

// The two arms of the rocker have equal length and form a right angle, and push-rod and spring are
// perpendicular to them. At rest the spring then moves by the same distance as the push-rod.
TEST(SpringDrive, ARightAngledRockerPassesTheMotionOn) {
  CornerGeometry corner = parallelogram();
  corner.spring.outer = {0.0, 0.6, 0.3};
  corner.spring.inner = {0.0, 0.6, 0.7};
  corner.spring.rocker = {{"rocker",
                           "push-rod",
                           {0.0, 0.5, 0.7},
                           Vector3d::UnitX(),
                           corner.spring.inner,
                           corner.spring.outer},
                          {0.0, 0.5, 0.8},
                          {0.0, 0.2, 0.8}};
  ASSERT_EQ(corner.spring.fault(), "");
  EXPECT_NEAR(state_of(corner, 0.0, 0.0).length_slopes[0], -1.0, 1e-12);
  EXPECT_NEAR(state_of(corner, 0.0, 0.0).length, 0.3, 1e-15);
  // The push-rod moves farther than the rocker's arms of 0.1 m allow.
  MovingLinkage moving(corner.linkage, TravelOf::contact);
  ASSERT_TRUE(moving.move_to(0.15, 0.0));
  const auto beyond =
      spring_state(corner.spring, corner.linkage.wheel.center, moving.upright(), moving.twists());
  ASSERT_FALSE(beyond);
  EXPECT_NE(beyond.failure().reason.find("the push-rod does not reach the rocker"),
            std::string::npos)
      << beyond.failure().reason;
}

TEST(SpringDrive, SlopesAreThoseOfDifferences) {
  const CornerGeometry corner = race_geometry();
  ASSERT_EQ(corner.fault(), "");
  for (const double travel : {0.0, 0.02, -0.025})
    for (const double rack : {0.0, 0.015}) {
      const SpringState at = state_of(corner, travel, rack);
      const double h = 1e-5;
      const SpringState up = state_of(corner, travel + h, rack);
      const SpringState down = state_of(corner, travel - h, rack);
      const SpringState left = state_of(corner, travel, rack + h);
      const SpringState right = state_of(corner, travel, rack - h);
      // Rounding errors of 1e-13 m divided by 2 h dominate; the truncation error is smaller.
      EXPECT_NEAR((up.length - down.length) / (2 * h), at.length_slopes[0], 3e-8);
      EXPECT_NEAR((left.length - right.length) / (2 * h), at.length_slopes[1], 3e-8);
      EXPECT_NEAR((up.blade_angle - down.blade_angle) / (2 * h), at.blade_slopes[0], 3e-6);
      EXPECT_NEAR((left.blade_angle - right.blade_angle) / (2 * h), at.blade_slopes[1], 3e-6);
    }
  EXPECT_NEAR(state_of(corner, 0.0, 0.0).blade_angle, 0.0, 1e-13);
}

TEST(SpringDrive, RodsKeepTheirLengths) {
  const CornerGeometry corner = race_geometry();
  const Lever& rocker = corner.spring.rocker->lever;
  for (const Vector3d& by : {Vector3d(0.0, 0.002, 0.02), Vector3d(0.001, -0.003, -0.03)}) {
    const auto turned = rocker.turned(rocker.driving + by);
    ASSERT_TRUE(turned) << turned.failure().reason;
    EXPECT_NEAR((rocker.at(turned->angle, rocker.own) - rocker.driving - by).norm(),
                (rocker.own - rocker.driving).norm(),
                1e-14);
  }
}

TEST(SpringDrive, FaultsNameTheirPart) {
  CornerGeometry bad = race_geometry();
  bad.spring.rocker->lever.own = bad.spring.rocker->lever.pivot;
  EXPECT_NE(bad.fault().find("rocker: it has no arm"), std::string::npos) << bad.fault();
  bad = race_geometry();
  bad.spring.rocker->spring_end = bad.spring.rocker->spring_on_chassis;
  EXPECT_EQ(bad.fault(), "rocker_damper and damper_chassis coincide");
  bad = race_geometry();
  Lever& rocker = bad.spring.rocker->lever;
  rocker.driving = rocker.own + 2.0 * (rocker.own - rocker.pivot);
  EXPECT_NE(bad.fault().find("turns nothing"), std::string::npos) << bad.fault();
}

}  // namespace
}  // namespace latsch::suspension
