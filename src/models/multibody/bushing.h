// SPDX-License-Identifier: Apache-2.0
// A bushing: six springs between two bodies, at a point of each that is one and the same at rest.
//   d = A' (p_b - p_a)          where b's point has gone, in the axes A of the bushing, fixed in a
//   F = -A k d                  on b at its own point; reversed on a at that same point
//   A' A_b = R_x(q_1) R_y(q_2) R_z(q_3),  q' = N ω,  M = -A N' c q       on b; reversed on a
// Both derive from (d' k d + q' c q)/2. Body-fixed angles 1-2-3 end where q_2 is a right angle.
#pragma once

#include <Eigen/Core>
#include <string>

#include "models/multibody/pose.h"

namespace latsch::multibody {

struct BushingParameters {
  Eigen::Vector3d stiffness;   // k, N/m
  Eigen::Vector3d rotational;  // c, N m/rad
  bool operator==(const BushingParameters&) const = default;
};

/// Its place in both bodies, from their origins in their axes.
struct BushingPlace {
  Eigen::Vector3d in_a, in_b;
  Eigen::Matrix3d axes_in_a = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d axes_in_b = Eigen::Matrix3d::Identity();
};

/// How far a bushing is from rest.
struct BushingStrain {
  Eigen::Vector3d d;      // m
  Eigen::Vector3d q;      // rad
  Eigen::Matrix3d axes;   // A
  Eigen::Matrix3d N;      // rad/s of q by ω, in the axes of the bushing
  double s1, c1, c2, t2;  // sines, cosines and tangents of q_1 and q_2
  Eigen::Vector3d arm_a;  // from a's origin to b's point, in the ground's axes, m
  Eigen::Vector3d arm_b;  // from b's
};

BushingStrain strain_of(const BushingPlace& place, const Pose& a, const Pose& b);

/// Forces and moments on both bodies, about their origins, in the ground's axes: N, N m.
struct BushingWrenches {
  Vector6d on_a, on_b;
};
BushingWrenches wrenches(const BushingStrain& strain, const BushingParameters& parameters);

/// How these change with travel and rotation [Pose::move] of a and b.
struct BushingTangent {
  Matrix6d aa, ab, ba, bb;
};
BushingTangent tangent(const BushingStrain& strain, const BushingParameters& parameters);

double energy(const BushingStrain& strain, const BushingParameters& parameters);  // J

}  // namespace latsch::multibody
