// SPDX-License-Identifier: Apache-2.0
// Wheel motions near and between given ones: parts of a step, and directions of derivatives.
#pragma once

#include <Eigen/Core>

#include "models/tire/tire.h"

namespace latsch::ring_tire {

/// Returns the motion at a share 0 .. 1 of the path; the carrier rotates about one axis.
WheelMotion between(const WheelMotion& from, const WheelMotion& to, double share);

/// Components of a motion by which forces are differentiated: columns, three for each vector,
/// inertial x, y, z.
enum MotionColumn {
  kByCenter = 0,           // m
  kByRotation = 3,         // rad, small rotation of the carrier about inertial axes
  kByVelocity = 6,         // m/s, of the center
  kByAngularVelocity = 9,  // rad/s, of the carrier
  kBySpin = 12,            // rad
  kBySpinRate = 13,        // rad/s
  kMotionColumns = 14
};

/// Returns the motion with `column` increased by `by`. A rotation rotates only the carrier:
/// velocities stay in inertial axes.
WheelMotion moved(const WheelMotion& motion, int column, double by);

/// Returns the increment for differences: nodes move by about 1e-7 m at the end of a step of this
/// length.
double difference_step(int column, double step);

/// d(hub force, then moment, in C)/d(motion), N and N m per unit of the column.
using HubSlopes = Eigen::Matrix<double, 6, kMotionColumns>;

/// Returns a Failure if the ring cannot take a step of that length, s, to `motion`.
Status check_step(const WheelMotion& motion, double step);

}  // namespace latsch::ring_tire
