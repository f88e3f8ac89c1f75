// SPDX-License-Identifier: Apache-2.0
// The compliance matrix of an axle and quantities derived from it. Rows are travel and rotation at
// both wheels, columns forces and moments there; x, y, z each, left wheel first, in ISO 8855 axes:
//
//   [d_L; d_R] = C [F_L; F_R],      C 12 x 12
//
// Loads in phase are equal on both wheels, loads out of phase opposite:
//
//   in phase C(i, j) + C(i, j + 6),   out of phase C(i, j) - C(i, j + 6)     of the left wheel
//
// Suspension analyses define lateral force steer, aligning torque camber and similar quantities in
// this way. If nothing couples the wheels (no anti-roll bar, no compliant rack), the compliances in
// phase and out of phase are equal. The matrix is linear about the state for which C was computed.
#pragma once

#include <Eigen/Core>
#include <array>

#include "models/suspension/wheel_position.h"

namespace latsch::suspension {

using Matrix12d = Eigen::Matrix<double, 12, 12>;

/// Returns the rows of `of_origin`, displacement and rotation of an upright at its origin,
/// converted to another point of the upright; `arm` leads from the origin to this point. If the
/// loads act at the same point, the compliance of an unloaded corner is symmetric.
Matrix6d travel_at(const Eigen::Vector3d& arm, const Matrix6d& of_origin);
/// Returns the compliance matrix of the right wheel from that of the left one (or vice versa), if
/// nothing couples the wheels.
Matrix6d mirrored_compliance(const Matrix6d& corner);
/// Returns the compliance matrix of an axle whose wheels are not coupled, from that of the left
/// corner.
Matrix12d uncoupled_axle(const Matrix6d& left);

enum class Phase { in, out };

/// Compliances of the left wheel. Toe-in and camber with the top outboard are positive;
/// displacements are positive in the direction of the load.
struct ClassicalCompliances {
  double lateral_force_toe, lateral_force_camber;  // rad/N, per force to the left
  double longitudinal_force_toe;                   // rad/N, per force forward
  // Compliances per moment that turns to the left, rad/(N m).
  double aligning_torque_toe, aligning_torque_camber;
  double longitudinal, lateral, vertical;  // m/N
};
/// Returns the classical compliances of an axle. Camber and toe are taken as rotations about x and
/// z, which holds for a wheel that is upright and points straight ahead.
ClassicalCompliances classical_compliances(const Matrix12d& axle, Phase phase);

}  // namespace latsch::suspension
