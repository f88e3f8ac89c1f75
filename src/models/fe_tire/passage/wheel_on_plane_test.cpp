// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/passage/wheel_on_plane.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "models/road/plane_road.h"

namespace latsch::fe_tire {
namespace {

using Eigen::AngleAxisd, Eigen::Matrix3d, Eigen::Vector3d;

/// A wheel that yaws, leans and pitches, and whose center moves, as functions of time.
WheelMotion moving(double t) {
  const auto carrier = [](double at) {
    return Matrix3d(AngleAxisd(0.1 + 0.7 * at, Vector3d::UnitZ()) *
                    AngleAxisd(0.2 - 0.4 * at, Vector3d::UnitX()) *
                    AngleAxisd(0.3 + 1.1 * at, Vector3d::UnitY()));
  };
  constexpr double kStep = 1e-6;
  WheelMotion motion;
  motion.carrier = carrier(t);
  const Matrix3d rate = (carrier(t + kStep) - carrier(t - kStep)) / (2.0 * kStep);
  const Matrix3d cross = rate * motion.carrier.transpose();
  motion.angular_velocity = {cross(2, 1), cross(0, 2), cross(1, 0)};
  motion.velocity = {12.0 + 3.0 * t, 1.5 - t, 0.4};
  motion.center = {12.0 * t + 1.5 * t * t, 1.5 * t - 0.5 * t * t, 0.3 + 0.4 * t};
  motion.spin = 40.0 * t;
  motion.spin_rate = 40.0;
  return motion;
}

WheelOnPlane at(double t, const ReferencePlane& plane = {}) {
  return *WheelOnPlane::of_motion(moving(t), plane, Vector3d::Zero(), t);
}

// The axes of the wheel are level, whatever the carrier's pitch, and turn as their angular velocity
// says; a mark on the rim turns in them with the spin.
TEST(WheelOnPlane, HasAxesThatTurnAsTheySay) {
  constexpr double kTime = 0.13, kStep = 1e-5;
  const WheelOnPlane now = at(kTime), next = at(kTime + kStep), before = at(kTime - kStep);
  EXPECT_NEAR(now.axes(2, 0), 0.0, 1e-15);
  EXPECT_LT((now.axes.transpose() * now.axes - Matrix3d::Identity()).norm(), 1e-14);
  const Matrix3d cross = now.axes.transpose() * (next.axes - before.axes) / (2.0 * kStep);
  EXPECT_LT((now.turning - Vector3d(cross(2, 1), cross(0, 2), cross(1, 0))).norm(), 1e-6);
  EXPECT_NEAR(now.of.camber, 0.2 - 0.4 * kTime, 1e-12);
  EXPECT_NEAR(now.place.heading, 0.1 + 0.7 * kTime, 1e-12);
  EXPECT_NEAR(now.of.turn_slip, -0.7 / now.of.speed, 1e-6);
  const auto mark = [](double t) {
    const WheelMotion motion = moving(t);
    const Vector3d on_rim =
        motion.carrier * (AngleAxisd(motion.spin, Vector3d::UnitY()) * Vector3d::UnitX());
    const Vector3d in_axes = at(t).axes.transpose() * on_rim;
    return std::atan2(-in_axes.z(), in_axes.x());
  };
  EXPECT_NEAR((mark(kTime + kStep) - mark(kTime - kStep)) / (2.0 * kStep), now.of.spin, 1e-5);
}

TEST(WheelOnPlane, MeetsTheGroundWithItsVelocityOverIt) {
  const Vector3d belt(-5.0, 0.5, 0.0);
  const WheelOnPlane wheel = *WheelOnPlane::of_motion(moving(0.0), {}, belt, 0.0);
  const Vector3d over = Vector3d(12.0, 1.5, 0.4) - belt;
  EXPECT_NEAR(wheel.of.speed, std::hypot(over.x(), over.y()), 1e-12);
  EXPECT_NEAR(wheel.of.slip_angle, std::atan2(over.y(), over.x()) - 0.1, 1e-12);
  EXPECT_NEAR(wheel.of.height, 0.3, 1e-15);
}

// On the way between two moments the wheel moves as with an even acceleration.
TEST(WheelOnPlane, MovesOnAParabolaBetweenTwoMoments) {
  constexpr double kStep = 2e-3;
  const auto straight = [](double t) {
    WheelMotion motion;
    motion.carrier = AngleAxisd(0.3, Vector3d::UnitZ()).toRotationMatrix() *
                     AngleAxisd(0.2, Vector3d::UnitX()).toRotationMatrix();
    motion.velocity = {12.0 + 30.0 * t, 1.5 - 10.0 * t, 0.4 - 50.0 * t};
    motion.center = {12.0 * t + 15.0 * t * t, 1.5 * t - 5.0 * t * t, 0.3 + 0.4 * t - 25.0 * t * t};
    return motion;
  };
  const auto wheel = [&](double t) {
    return *WheelOnPlane::of_motion(straight(t), {}, Vector3d::Zero(), t);
  };
  const WheelMoment half = moment_between(wheel(0.0), wheel(kStep), 0.5, kStep);
  const WheelOnPlane expected = wheel(0.5 * kStep);
  EXPECT_NEAR(half.of.height, expected.of.height, 1e-15);
  EXPECT_LT((half.place.way - expected.place.way).norm(), 1e-15);
  EXPECT_LT((expected.axes * half.acceleration - Vector3d(30.0, -10.0, -50.0)).norm(), 1e-9);
}

TEST(WheelOnPlane, StandsOnThePlaneOfItsRoad) {
  const road::PlaneRoad road({.height = 0.3, .grade = 0.1, .bank = -0.05});
  const ReferencePlane plane = plane_below(road, {2.0, 1.0, 1.0}, 0.0);
  EXPECT_LT((plane.axes.col(2) - road.at(0.0, 0.0, 0.0).normal).norm(), 1e-12);
  EXPECT_NEAR(plane.to_plane({5.0, -3.0, road.height(5.0, -3.0, 0.0)}).z(), 0.0, 1e-12);
}

TEST(WheelOnPlane, RefusesAWheelThatLiesFlat) {
  WheelMotion motion;
  motion.carrier = AngleAxisd(1.4, Vector3d::UnitX()).toRotationMatrix();
  EXPECT_FALSE(WheelOnPlane::of_motion(motion, {}, Vector3d::Zero(), 0.0));
}

}  // namespace
}  // namespace latsch::fe_tire
