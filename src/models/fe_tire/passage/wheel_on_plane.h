// SPDX-License-Identifier: Apache-2.0
// The motion of a wheel as a tire that rolls on a plane sees it.
//
// The wheel's axes W have x along the plane, y along the spin axis and z up in the wheel's plane.
// They turn with
//   w_W = w_C - (w_C y_g / cos gamma) e,                                                      (V.6)
// the rotation that follows the spin axis e and keeps x level, with w_C the angular velocity of the
// carrier and y_g the level axis to the left. About e the carrier turns faster than W by
// w_C y_g / cos gamma, which adds to the spin.
#pragma once

#include <Eigen/Core>

#include "base/result.h"
#include "models/fe_tire/grip/road_ground.h"
#include "models/fe_tire/passage/wheel_moment.h"
#include "models/tire/tire.h"

namespace latsch::fe_tire {

struct WheelOnPlane {
  /// Speed and slip angle over the ground, camber, turn slip, height and spin; 0 if not stated.
  RollingCase of;
  WheelPlace place;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  // columns: W in the inertial frame
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // m/s, of the center, inertial
  Eigen::Vector3d turning = Eigen::Vector3d::Zero();   // rad/s, w_W in W
  double more_spin = 0.0;  // rad/s, spin in W less the rate of the rim in its carrier

  /// Describes a wheel over a plane whose ground moves with this velocity, m/s, inertial. A Failure
  /// says that the wheel lies flat on the plane.
  static Result<WheelOnPlane> of_motion(const WheelMotion& motion,
                                        const ReferencePlane& plane,
                                        const Eigen::Vector3d& ground,
                                        double time);
};

/// Returns the moment at a share, 0 to 1, of a step of `step`, s, from a wheel to the next, during
/// which the velocity changes evenly. Heights and ways follow it and end where the step ends.
WheelMoment moment_between(const WheelOnPlane& from,
                           const WheelOnPlane& to,
                           double share,
                           double step);

/// Returns the plane of the road below a wheel, m: its mean over 0.1 m to all sides.
ReferencePlane plane_below(const road::Road& road, const Eigen::Vector3d& center, double time);

}  // namespace latsch::fe_tire
