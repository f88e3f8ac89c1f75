// SPDX-License-Identifier: Apache-2.0
// A bushing: six springs and dampers between two bodies, at a point of each that is one and the
// same at rest.
//   d = A' (p_b - p_a)          where b's point has gone, in the axes A of the bushing, fixed in a
//   F = -A f(d, d')             on b at its own point; reversed on a at that same point
//   A' A_b = R_x(q_1) R_y(q_2) R_z(q_3),  q' = N ω,  M = -A N' t(q, q')      on b; reversed on a
// with f = k d + c d' and t alike, and what parts of an axis add (force_part.h). Without dampers
// and parts both derive from (d' k d + q' c q)/2. Body-fixed angles 1-2-3 end where q_2 is a right
// angle.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "models/multibody/force_part.h"
#include "models/multibody/pose.h"

namespace latsch::multibody {

struct BushingParameters {
  Eigen::Vector3d stiffness;                                     // k, N/m
  Eigen::Vector3d rotational;                                    // N m/rad
  Eigen::Vector3d damping = Eigen::Vector3d::Zero();             // c, N s/m
  Eigen::Vector3d rotational_damping = Eigen::Vector3d::Zero();  // N m s/rad
  /// What an axis has beside these: x, y, z, about x, y, z.
  struct Part {
    int axis;
    ForcePart law;
    bool operator==(const Part&) const = default;
  };
  std::vector<Part> parts = {};
  /// Stands for a joint without compliance that turns freely (rod_spin.h): alike along all axes, no
  /// rotational stiffness, no parts that turn.
  bool rigid = false;
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

/// d' and q', m/s and rad/s, of velocities and angular velocities of both bodies.
Vector6d rates_of(const BushingStrain& strain, const Vector6d& a, const Vector6d& b);

/// f and t in the axes of the bushing, and their slopes in d and q.
struct BushingForces {
  Vector6d f, slopes;
};

/// Of springs alone.
BushingForces spring_forces(const BushingStrain& strain, const BushingParameters& parameters);
/// Of a bushing that moves, its slopes those in d and q where rates change by `rate_share` times
/// what d and q do. `memory` holds a place for each part; `kept`, where it is not null, takes what
/// is to be remembered.
BushingForces forces_in_motion(const BushingStrain& strain,
                               const Vector6d& rates,
                               const BushingParameters& parameters,
                               double rate_share,
                               const PartMemory* memory,
                               double step,
                               PartMemory* kept);

/// Forces and moments on both bodies, about their origins, in the ground's axes: N, N m.
struct BushingWrenches {
  Vector6d on_a, on_b;
};
BushingWrenches wrenches(const BushingStrain& strain, const BushingForces& forces);
BushingWrenches wrenches(const BushingStrain& strain, const BushingParameters& parameters);

/// How these change with travel and rotation [Pose::move] of a and b.
struct BushingTangent {
  Matrix6d aa, ab, ba, bb;
};
BushingTangent tangent(const BushingStrain& strain, const BushingForces& forces);
BushingTangent tangent(const BushingStrain& strain, const BushingParameters& parameters);

/// Of its springs and of what its parts store, J.
double energy(const BushingStrain& strain,
              const BushingParameters& parameters,
              const PartMemory* memory = nullptr);

}  // namespace latsch::multibody
