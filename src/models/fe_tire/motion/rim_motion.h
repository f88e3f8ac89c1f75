// SPDX-License-Identifier: Apache-2.0
// The rim as a rigid body on a tire of revolution: which of its motions a wave around the tire
// takes along.
//
// In a wave u_s = Re(phi exp(i n theta_s)), in sector frames, a rim moves along and about the spin
// axis with n = 0, and along and about the diameters with n = 1, where both motions are circular:
// the vector a = (1, 0, i) / sqrt(2) turns with the frames, a_s = a exp(i theta_s). It does not
// move with n > 1. A node of the rim at x moves by
//   u = T q,   n = 0: T = [e, e x X],   n = 1: T = [a, a x X].
// The tilting rim of a spinning wheel resists by the moment omega Omega I_s, which makes its
// nutation travel with the spin.
#pragma once

#include <Eigen/Core>
#include <complex>

#include "models/fe_tire/description/tire_description.h"

namespace latsch::fe_tire {

/// Freedom of the rim to move.
enum class RimMotion {
  held,   // it does not move
  rigid,  // it is a rigid body on the springs of its RimBody
  free,   // it is a rigid body that only the tire holds, as on soft cords
};

struct Rim {
  RimMotion motion = RimMotion::held;
  RimBody body = {};

  /// Number of motions that a wave of n waves around takes along.
  int motions(int n) const { return motion == RimMotion::held || n > 1 ? 0 : 2; }
};

/// Returns T at the place X (m, sector frame) for n = 0 or 1.
Eigen::Matrix<std::complex<double>, 3, 2> rim_displacements(int n, const Eigen::Vector3d& X);

/// Diagonals over the two motions for n = 0 or 1.
struct RimMatrices {
  Eigen::Vector2d M;        // kg, kg m^2
  Eigen::Vector2d G;        // kg, kg m^2: omega G for a speed of 1 rad/s
  Eigen::Vector2d springs;  // N/m, N m/rad; 0 if the rim is free
};
RimMatrices rim_matrices(int n, const Rim& rim);

}  // namespace latsch::fe_tire
