// SPDX-License-Identifier: Apache-2.0
// Modal Assurance Criterion: likeness of two mode shapes, independent of their scale and sign.
//
//   MAC(phi, psi) = |phi^H psi|^2 / ((phi^H phi) (psi^H psi))          [Allemang & Brown 1982]
//
// Modes of equal frequency have no unique shapes: any two vectors of the plane they span are modes.
// For them the spans are compared. With orthonormal bases Q_A, Q_B and the principal angles theta_i
// between the spans
//
//   MAC(A, B) = |Q_A^H Q_B|_F^2 / min(dim A, dim B) = mean cos^2 theta_i
//
// which equals the vector MAC in one dimension and is 1 if the smaller span lies inside the larger.
// Shapes here are real.
#pragma once

#include <Eigen/Core>

namespace latsch::correlation {

/// Returns the MAC in [0, 1]; 0 if one of the matrices is zero. The columns span the subspaces
/// [points x modes]; linearly dependent columns count once.
double mac(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

}  // namespace latsch::correlation
