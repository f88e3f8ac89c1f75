// SPDX-License-Identifier: Apache-2.0
// Builds the mechanism of a car, that is its bodies, joints and struts, and gives the indices of
// its parts.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "models/car/car_parameters.h"
#include "models/multibody/mechanism.h"

namespace latsch::car {

/// Corners of a car: front left, front right, rear left, rear right; kCorners is their number.
enum Corner { kFL, kFR, kRL, kRR, kCorners };
constexpr std::array<const char*, kCorners> kCornerNames = {"FL", "FR", "RL", "RR"};
constexpr bool is_left(int corner) { return corner % 2 == 0; }
constexpr bool is_front(int corner) { return corner < kRL; }

/// Indices of a corner's parts in the mechanism.
struct CornerParts {
  int upright = -1, pushrod_joint = -1;
  int first_joint = -1;  // first of DoubleWishbone::kJoints, in their order
  int unit = -1;         // index of the spring unit's strut; -1: the spring is locked
  Eigen::Vector3d wheel_center, contact;  // positions at rest, m
  Eigen::Vector3d pushrod_outer, pushrod_inner;
  int pushrod = -1;
  Eigen::Matrix3d wheel_axes;  // wheel axes in the upright, as columns; y is the spin axis
  suspension::WheelPoints points;
};

struct CarParts {
  // Indices of the chassis' halves; equal if the chassis is rigid.
  int chassis = 0, chassis_rear = 0;
  std::array<CornerParts, kCorners> corners;
};

struct CarMechanism {
  multibody::Mechanism mechanism;
  CarParts parts;
};

constexpr int kRackDriver = 0;  // driver: displacement of the rack to the left, m
constexpr int kDrivers = 1;

/// Builds the mechanism. The parameters must have no fault(), so no InputError is thrown.
CarMechanism build(const CarParameters& parameters);

}  // namespace latsch::car
