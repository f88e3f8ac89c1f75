// SPDX-License-Identifier: Apache-2.0
// Modal Assurance Criterion: how alike two mode shapes are, whatever their scale and sign.
//
//   MAC(phi, psi) = |phi^H psi|^2 / ((phi^H phi) (psi^H psi))          [Allemang & Brown 1982]
//
// Modes of equal frequency have no shapes of their own: any two vectors of the plane they span are
// modes. For them the spans are compared. With orthonormal bases Q_A, Q_B and the principal angles
// theta_i between the spans
//
//   MAC(A, B) = |Q_A^H Q_B|_F^2 / min(dim A, dim B) = mean cos^2 theta_i
//
// which is the vector MAC in one dimension and 1 where the smaller span lies inside the larger.
// Shapes here are real.
#pragma once

#include <Eigen/Core>

namespace latsch::correlation {

/// In [0, 1]; 0 where one of them is zero. The columns span the subspaces [points x modes];
/// linearly dependent columns count once.
double mac(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

}  // namespace latsch::correlation
