// SPDX-License-Identifier: Apache-2.0
// Inflation pressure on a four-node face, following the deformation, with its load stiffness.
#pragma once

#include <Eigen/Core>

namespace latsch::fe_tire {

using Matrix34 = Eigen::Matrix<double, 3, 4>;
using Vector12 = Eigen::Matrix<double, 12, 1>;
using Matrix12 = Eigen::Matrix<double, 12, 12>;

/// Adds the internal-force contribution of pressure p (Pa) on the face with current nodes x [3 x
/// 4], m: the face's normal (x_xi cross x_eta) points away from the gas, so f -= p * int N n dA. K,
/// where given, receives the symmetric part of df/dx (exact over a closed or held boundary), so
/// that f and K add up like those of the elements.
void add_pressure(const Matrix34& x, double p, Vector12& f, Matrix12* K);

/// The same on the seal of the face's open edge from node k to node k + 1 (mod 4): the strip from
/// where the edge is, x, to where the rim has it in the undeformed tire, X. It closes the gas, so
/// that the load has a potential and the symmetric parts of all faces are all of its stiffness.
void add_sealed_edge(
    const Matrix34& X, const Matrix34& x, int k, double p, Vector12& f, Matrix12* K);

}  // namespace latsch::fe_tire
