// SPDX-License-Identifier: Apache-2.0
// A bushing: six springs and dampers between two bodies, at a point of each; the two points
// coincide at rest.
//   d = A' (p_b - p_a)          displacement of b's point, in the bushing's axes A, fixed in a
//   F = -A f(d, d')             on b at its own point; reversed on a at that same point
//   A' A_b = R_x(q_1) R_y(q_2) R_z(q_3),  q' = N ω,  M = -A N' t(q, q')      on b; reversed on a
// Here f = k d + c d' plus the parts of an axis (force_part.h), and t likewise. Without dampers and
// parts both derive from (d' k d + q' c q)/2. The body-fixed angles 1-2-3 become singular if q_2 is
// a right angle.
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
  /// Additional force law of one axis: 0 to 2 for x, y, z, 3 to 5 for rotations about x, y, z.
  struct Part {
    int axis;
    ForcePart law;
    bool operator==(const Part&) const = default;
  };
  std::vector<Part> parts = {};
  /// True for a joint without compliance that turns freely (rod_spin.h). Its stiffness is then
  /// equal along all axes, and it has neither rotational stiffness nor force parts about its axes.
  bool rigid = false;
  bool operator==(const BushingParameters&) const = default;
};

/// Attachment points of a bushing on both bodies, relative to their origins, in the axes of the
/// bodies.
struct BushingPlace {
  Eigen::Vector3d in_a, in_b;
  Eigen::Matrix3d axes_in_a = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d axes_in_b = Eigen::Matrix3d::Identity();
};

/// Deformation of a bushing and the kinematic quantities that follow from it.
struct BushingStrain {
  Eigen::Vector3d d;      // m
  Eigen::Vector3d q;      // rad
  Eigen::Matrix3d axes;   // A
  Eigen::Matrix3d N;      // matrix with q' = N ω, ω in the axes of the bushing
  double s1, c1, c2, t2;  // sines, cosines and tangents of q_1 and q_2
  Eigen::Vector3d arm_a;  // m, from the origin of body a to b's point, in the ground's axes
  Eigen::Vector3d arm_b;  // m, from the origin of body b to its point, in the ground's axes
};

BushingStrain strain_of(const BushingPlace& place, const Pose& a, const Pose& b);

/// Returns the rates d' and q', m/s and rad/s, for the velocities and angular velocities of both
/// bodies.
Vector6d rates_of(const BushingStrain& strain, const Vector6d& a, const Vector6d& b);

/// Forces f and moments t in the axes of the bushing, and their derivatives by d and q.
struct BushingForces {
  Vector6d f, slopes;
};

/// Computes the forces of the springs alone, without dampers and force parts.
BushingForces spring_forces(const BushingStrain& strain, const BushingParameters& parameters);
/// Computes the forces of a moving bushing and their derivatives by d and q. The derivatives are
/// total: the rates change by `rate_share` times the changes of d and q. `memory` holds one entry
/// per force part. If `kept` is not null, it receives the new memories.
BushingForces forces_in_motion(const BushingStrain& strain,
                               const Vector6d& rates,
                               const BushingParameters& parameters,
                               double rate_share,
                               const PartMemory* memory,
                               double step,
                               PartMemory* kept);

/// Forces and moments on both bodies about their origins, in the ground's axes: N, N m.
struct BushingWrenches {
  Vector6d on_a, on_b;
};
BushingWrenches wrenches(const BushingStrain& strain, const BushingForces& forces);
BushingWrenches wrenches(const BushingStrain& strain, const BushingParameters& parameters);

/// Derivatives of the wrenches on bodies a and b with respect to displacement and rotation
/// [Pose::move] of a and b.
struct BushingTangent {
  Matrix6d aa, ab, ba, bb;
};
BushingTangent tangent(const BushingStrain& strain, const BushingForces& forces);
BushingTangent tangent(const BushingStrain& strain, const BushingParameters& parameters);

/// Returns the energy stored in the springs and force parts, J.
double energy(const BushingStrain& strain,
              const BushingParameters& parameters,
              const PartMemory* memory = nullptr);

}  // namespace latsch::multibody
