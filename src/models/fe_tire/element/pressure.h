// SPDX-License-Identifier: Apache-2.0
// Inflation pressure on a four-node face. It follows the deformation, which gives a load stiffness.
// The equations are in pressure_kernel.h.
#pragma once

#include <Eigen/Core>

namespace latsch::fe_tire {

using Matrix34 = Eigen::Matrix<double, 3, 4>;
using Vector12 = Eigen::Matrix<double, 12, 1>;
using Matrix12 = Eigen::Matrix<double, 12, 12>;

/// Adds the contribution of the pressure p (Pa) on a face, with nodes at x [3 x 4], m, to the
/// internal forces. The face's normal (x_xi cross x_eta) points away from the gas, so f -= p * int
/// N n dA. If K is not null, it receives the symmetric part of df/dx, which is exact for a closed
/// or clamped surface. f and K can be added to those of the elements.
void add_pressure(const Matrix34& x, double p, Vector12& f, Matrix12* K);

}  // namespace latsch::fe_tire
