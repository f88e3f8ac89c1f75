// SPDX-License-Identifier: Apache-2.0
// The bodies, joints and struts of a car, and which is where among them.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "models/car/car_parameters.h"
#include "models/multibody/mechanism.h"

namespace latsch::car {

/// Front left, front right, rear left, rear right.
enum Corner { kFL, kFR, kRL, kRR, kCorners };
constexpr std::array<const char*, kCorners> kCornerNames = {"FL", "FR", "RL", "RR"};
constexpr bool is_left(int corner) { return corner % 2 == 0; }
constexpr bool is_front(int corner) { return corner < kRL; }

/// Where a corner's parts are in the mechanism.
struct CornerParts {
  int upright = -1, pushrod_joint = -1;
  int first_joint = -1;                   // of DoubleWishbone::kJoints, in their order
  int unit = -1;                          // strut; -1: locked
  Eigen::Vector3d wheel_center, contact;  // at rest, m
  Eigen::Vector3d pushrod_outer, pushrod_inner;
  int pushrod = -1;
  Eigen::Matrix3d wheel_axes;  // of the wheel in the upright: columns; y is the spin axis
  suspension::WheelPoints points;
};

struct CarParts {
  int chassis = 0, chassis_rear = 0;  // the same where it is rigid
  std::array<CornerParts, kCorners> corners;
};

struct CarMechanism {
  multibody::Mechanism mechanism;
  CarParts parts;
};

constexpr int kRackDriver = 0;  // m, to the left
constexpr int kDrivers = 1;

/// InputError-free: of parameters without fault.
CarMechanism build(const CarParameters& parameters);

}  // namespace latsch::car
