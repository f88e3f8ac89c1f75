// SPDX-License-Identifier: Apache-2.0
// Position of a wheel as measured on a K&C rig (kinematics and compliance). Left and right wheels
// have the same signs: camber positive with the top outboard, toe with the front inboard, caster
// with the top of the kingpin rearward.
//   a = R (0, 1, 0):  camber = -asin a_z,  toe = -atan2(-a_x, a_y)       left; right: reversed
//   caster = atan2(-k_x, k_z) of the line k from lower to upper ball joint
#pragma once

#include <Eigen/Core>

#include "models/multibody/pose.h"

namespace latsch::suspension {

using multibody::cross;
using multibody::Matrix6d;
using multibody::Pose;
using multibody::Vector6d;

/// Side of the car.
enum class Side { left, right };

/// Points of the upright at rest, relative to its origin, m.
struct WheelPoints {
  Eigen::Vector3d contact, center, lower_ball_joint, upper_ball_joint;  // m
  Side side = Side::left;  // side of the car: the signs of toe, camber and steer depend on it
};

struct WheelPosition {
  Eigen::Vector3d contact;  // m, position of the upright's point that was the contact point at rest
  Eigen::Vector3d center;   // m
  double camber, toe, caster;  // rad
};

/// Returns the position of the wheel for this pose of the upright.
WheelPosition wheel_position(const WheelPoints& points, const Pose& upright);

/// Returns the derivatives of contact point, camber, toe and caster (rows) with respect to
/// displacement and rotation of the upright [Pose::move] (columns).
Matrix6d wheel_slopes(const WheelPoints& points, const Pose& upright);

}  // namespace latsch::suspension
