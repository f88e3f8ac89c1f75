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
// this way. If nothing couples the wheels (anti-roll bar, compliant rack), both are equal. The
// matrix is linear about the state for which C was computed.
#pragma once

#include <Eigen/Core>
#include <array>

#include "models/suspension/wheel_position.h"

namespace latsch::suspension {

using Matrix12d = Eigen::Matrix<double, 12, 12>;

/// Converts travel of an upright's origin to travel of a point of it; `arm` leads from the origin
/// to the point. If the loads act at the point too, the result is symmetric for an unloaded corner.
Matrix6d travel_at(const Eigen::Vector3d& arm, const Matrix6d& of_origin);
/// Returns the compliance of the other wheel if nothing couples them.
Matrix6d mirrored_compliance(const Matrix6d& corner);
/// Returns the compliance of both wheels of an axle without coupling, from that of the left one.
Matrix12d uncoupled_axle(const Matrix6d& left);

enum class Phase { in, out };

/// Compliances of the left wheel: toe-in, camber with the top outboard, travel in the direction of
/// the load.
struct ClassicalCompliances {
  double lateral_force_toe, lateral_force_camber;      // rad/N, by a force to the left
  double longitudinal_force_toe;                       // rad/N, by a force forward
  double aligning_torque_toe, aligning_torque_camber;  // rad/(N m), by a moment to the left
  double longitudinal, lateral, vertical;              // m/N
};
/// Camber and toe are taken as rotations about x and z, for a wheel that stands upright and
/// straight ahead.
ClassicalCompliances classical_compliances(const Matrix12d& axle, Phase phase);

}  // namespace latsch::suspension
