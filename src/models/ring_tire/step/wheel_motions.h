// SPDX-License-Identifier: Apache-2.0
// Wheel motions beside and between others: parts of a step, and directions of derivatives.
#pragma once

#include <Eigen/Core>
#include <string>

#include "models/tire/tire.h"

namespace latsch::ring_tire {

/// The motion at a share 0 .. 1 of the way; the carrier turns about one axis.
WheelMotion between(const WheelMotion& from, const WheelMotion& to, double share);

/// What of a motion forces are derived by: columns, three of each vector, inertial x, y, z.
enum MotionColumn {
  kByCenter = 0,           // m
  kByRotation = 3,         // rad, small rotation of the carrier about inertial axes
  kByVelocity = 6,         // m/s, of the center
  kByAngularVelocity = 9,  // rad/s, of the carrier
  kBySpin = 12,            // rad
  kBySpinRate = 13,        // rad/s
  kMotionColumns = 14
};

/// All as it was but `column`, which is `by` more. A rotation turns the carrier alone: velocities
/// stay in inertial axes.
WheelMotion moved(const WheelMotion& motion, int column, double by);

/// By how much to move for differences: nodes differ by about 1e-7 m at the end of a step so long.
double difference_step(int column, double step);

/// d(hub force, then moment, in C)/d(motion), N and N m per unit of the column.
using HubSlopes = Eigen::Matrix<double, 6, kMotionColumns>;

/// Empty, or why the ring cannot take a step of that length, s, to `motion`.
std::string trouble_with_step(const WheelMotion& motion, double step);

}  // namespace latsch::ring_tire
