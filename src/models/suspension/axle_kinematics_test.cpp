// SPDX-License-Identifier: Apache-2.0
#include "models/suspension/axle_kinematics.h"

#include <gtest/gtest.h>

#include "models/suspension/geometry_testing.h"

namespace latsch::suspension {
namespace {

KinematicAxle::Wheels wheels(const CornerGeometry& corner, double left, double right, double rack) {
  const auto found = KinematicAxle(corner, TravelOf::contact).move_to(left, right, rack);
  EXPECT_TRUE(found) << found.failure().reason;
  return *found;
}

// An axle made from a left corner must equal the axle made from its mirror image, to rounding.
TEST(Axle, IsTheSameFromEitherOfItsCorners) {
  const CornerGeometry left = race_geometry(), right = right_of(left);
  const auto a = wheels(left, 0.02, -0.015, 0.01), b = wheels(right, 0.02, -0.015, 0.01);
  for (const auto& [one, other] : {std::pair{a.left, b.left}, {a.right, b.right}}) {
    EXPECT_NEAR(one.toe, other.toe, 1e-12);
    EXPECT_NEAR(one.steer, other.steer, 1e-12);
    EXPECT_NEAR(one.camber, other.camber, 1e-12);
    EXPECT_NEAR(one.contact_y, other.contact_y, 1e-12);
    EXPECT_NEAR(one.roll_center_height, other.roll_center_height, 1e-12);
    EXPECT_NEAR(one.steer_by_rack, other.steer_by_rack, 1e-11);
    EXPECT_NEAR(one.spring_length, other.spring_length, 1e-12);
  }
}

TEST(Axle, StandsLevelInParallelTravel) {
  const auto [left, right] = wheels(race_geometry(), 0.02, 0.02, 0.0);
  const AxleKinematics axle = axle_of(left, right, 0.8);
  EXPECT_EQ(axle.roll, 0.0);
  EXPECT_NEAR(axle.track, 2.0 * left.contact_y, 1e-15);
  EXPECT_NEAR(axle.roll_center_y, 0.0, 1e-15);
  EXPECT_NEAR(axle.roll_center_height, left.roll_center_height, 1e-15);
  EXPECT_NEAR(axle.force_roll_center_height, left.roll_center_height, 1e-15);
}

// The line of the ground passes through both contact points. If the chassis rolls about the
// kinematic roll center, the contact points move, to first order, on circles about it.
TEST(Axle, BothContactPointsMoveAboutTheRollCenter) {
  const auto [left, right] = wheels(race_geometry(), 0.02, -0.02, 0.0);
  const AxleKinematics axle = axle_of(left, right, 0.5);
  // The left wheel is higher in the chassis, so the left side of the chassis is lower.
  EXPECT_LT(axle.roll, 0.0);
  EXPECT_NEAR(std::sin(axle.roll), -0.04 / axle.track, 1e-12);
  const double ground = right.contact_z + (left.contact_z - right.contact_z) /
                                              (left.contact_y - right.contact_y) *
                                              (axle.roll_center_y - right.contact_y);
  const double z = ground + axle.roll_center_height / std::cos(axle.roll);
  for (const WheelKinematics& w : {left, right}) {
    const double along = w.contact_y_by_travel * (w.contact_y - axle.roll_center_y) +
                         w.contact_z_by_travel * (w.contact_z - z);
    EXPECT_NEAR(along, 0.0, 1e-13);
  }
  // The force-based roll center lies between the heights at which the two normals meet the center
  // plane.
  EXPECT_NE(axle_of(left, right, 1.0).force_roll_center_height,
            axle_of(left, right, 0.0).force_roll_center_height);
}

// Toe and inclination relative to the ground are those of a chassis that has rolled while both
// contact points stay on the ground.
TEST(Axle, RollSteerAndRollCamberAreSlopesOfOpposedTravel) {
  const CornerGeometry corner = race_geometry();
  const double h = 1e-4;
  const auto middle = wheels(corner, 0.0, 0.0, 0.0);
  const auto up = wheels(corner, h, -h, 0.0), down = wheels(corner, -h, h, 0.0);
  const AxleKinematics a = axle_of(up.left, up.right, 0.5), b = axle_of(down.left, down.right, 0.5);
  const double roll = a.roll - b.roll, track = 2.0 * middle.left.contact_y;
  for (const bool is_left : {true, false}) {
    const WheelKinematics& w = is_left ? middle.left : middle.right;
    const WheelKinematics& u = is_left ? up.left : up.right;
    const WheelKinematics& d = is_left ? down.left : down.right;
    EXPECT_NEAR((u.steer - d.steer) / roll, roll_steer(w, track), 1e-6);
    // A rotation that leans a wheel to the right is positive about x, while positive camber leans a
    // left wheel to the left.
    const double side = is_left ? -1.0 : 1.0;
    EXPECT_NEAR(1.0 + side * (u.camber - d.camber) / roll, roll_camber(w, track), 1e-6);
  }
}

// If the axes of the wishbones rise toward the front, the wheel travels perpendicular to them,
// upward and rearward. The anti-dive of a front axle is then negative, and the anti-lift of a rear
// axle positive.
TEST(Axle, AntiFeaturesAreThoseOfThePath) {
  const double angle = 0.1, wheelbase = 1.6, cg_height = 0.3;
  const VehicleData front{wheelbase, cg_height, true, 0.6, 0.2, true};
  const VehicleData rear{wheelbase, cg_height, false, 0.4, 1.0, true};
  const WheelKinematics w = wheels(parallelogram(angle), 0.0, 0.0, 0.0).left;
  const double ratio = std::tan(angle) * wheelbase / cg_height;
  EXPECT_NEAR(anti_features(w, front).braking, -0.6 * ratio, 1e-12);
  EXPECT_NEAR(anti_features(w, front).driving, -0.2 * ratio, 1e-12);
  EXPECT_NEAR(anti_features(w, rear).braking, 0.4 * ratio, 1e-12);
  EXPECT_NEAR(anti_features(w, rear).driving, 1.0 * ratio, 1e-12);
}

// Outboard brakes act at the contact point, inboard brakes at the wheel center. If the wheel turns
// about y when it rises, their longitudinal displacements differ by the radius times this rotation.
TEST(Axle, InboardBrakesActAtTheWheelCenter) {
  const CornerGeometry corner = race_geometry();
  const WheelKinematics w = wheels(corner, 0.0, 0.0, 0.0).left;
  const VehicleData outboard{1.55, 0.3, true, 0.6, 0.0, true};
  VehicleData inboard = outboard;
  inboard.has_outboard_brakes = false;
  MovingLinkage moving(corner.linkage, TravelOf::contact);
  const double pitch = moving.twists().by_travel[4];
  EXPECT_NEAR(
      anti_features(w, outboard).braking - anti_features(w, inboard).braking,
      0.6 * 1.55 / 0.3 *
          (w.center_x_by_travel - 0.235 * pitch - w.center_x_by_travel / w.center_z_by_travel),
      1e-12);
}

TEST(Axle, AckermannIsOneWhereBothWheelsRollAboutOnePoint) {
  const double wheelbase = 1.6, track = 1.2;
  for (const double radius : {3.0, 8.0, 40.0}) {
    const double inner = std::atan(wheelbase / (radius - 0.5 * track));
    const double outer = std::atan(wheelbase / (radius + 0.5 * track));
    EXPECT_NEAR(ackermann(inner, outer, track, wheelbase), 1.0, 1e-10);
    EXPECT_NEAR(ackermann(-outer, -inner, track, wheelbase), 1.0, 1e-10);
    EXPECT_NEAR(ackermann(outer, inner, track, wheelbase) < 0.0, true, 0.0);
  }
  EXPECT_EQ(ackermann(0.2, 0.2, track, wheelbase), 0.0);
}

}  // namespace
}  // namespace latsch::suspension
