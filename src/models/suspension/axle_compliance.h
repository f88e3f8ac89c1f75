// SPDX-License-Identifier: Apache-2.0
// The compliance matrix of an axle and what is read from it. Rows: travel and rotation at both
// wheels; columns: forces and moments there; x, y, z each, left wheel first, in ISO 8855 axes:
//
//   [d_L; d_R] = C [F_L; F_R],      C 12 x 12
//
// Loads in phase are the same on both wheels, loads out of phase opposite:
//
//   in phase C(i, j) + C(i, j + 6),   out of phase C(i, j) - C(i, j + 6)     of the left wheel
//
// as suspension analyses define lateral force steer, aligning torque camber and their like. Without
// what couples the wheels (anti-roll bar, rack that gives) both are the same. Linear: about the
// state in which C was taken.
#pragma once

#include <Eigen/Core>
#include <array>

#include "models/suspension/wheel_position.h"

namespace latsch::suspension {

using Matrix12d = Eigen::Matrix<double, 12, 12>;

/// Of the travel of a point of the upright, from that of its origin; the arm leads from there to
/// the point. With loads at the point as well it is symmetric where nothing is loaded.
Matrix6d travel_at(const Eigen::Vector3d& arm, const Matrix6d& of_origin);
/// Of the other wheel, where nothing couples them.
Matrix6d mirrored_compliance(const Matrix6d& corner);
/// Of both wheels of an axle that nothing couples, from its left one's.
Matrix12d uncoupled_axle(const Matrix6d& left);

enum class Phase { in, out };

/// Of the left wheel: toe-in, camber with the top outboard, travel in the direction of the load.
struct ClassicalCompliances {
  double lateral_force_toe, lateral_force_camber;      // rad/N, by a force to the left
  double longitudinal_force_toe;                       // rad/N, by a force forward
  double aligning_torque_toe, aligning_torque_camber;  // rad/(N m), by a moment to the left
  double longitudinal, lateral, vertical;              // m/N
};
/// Camber and toe as turns about x and z: of a wheel that stands upright and straight ahead.
ClassicalCompliances classical_compliances(const Matrix12d& axle, Phase phase);

}  // namespace latsch::suspension
