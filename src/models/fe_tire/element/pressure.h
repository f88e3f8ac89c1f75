// SPDX-License-Identifier: Apache-2.0
// Inflation pressure on one four-node face, following the deformation, with its load stiffness; the
// law is in pressure_kernel.h.
#pragma once

#include <Eigen/Core>

namespace latsch::fe_tire {

using Matrix34 = Eigen::Matrix<double, 3, 4>;
using Vector12 = Eigen::Matrix<double, 12, 1>;
using Matrix12 = Eigen::Matrix<double, 12, 12>;

/// Adds the internal-force contribution of pressure p (Pa) on the face with current nodes x [3 x
/// 4], m. The face's normal (x_xi cross x_eta) points away from the gas, so f -= p * int N n dA. If
/// K is not null, it receives the symmetric part of df/dx (exact over a closed or held boundary),
/// so that f and K add up like those of the elements.
void add_pressure(const Matrix34& x, double p, Vector12& f, Matrix12* K);

}  // namespace latsch::fe_tire
