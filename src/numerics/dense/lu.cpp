// SPDX-License-Identifier: Apache-2.0
#include "numerics/dense/lu.h"

namespace latsch::numerics {

void Lu::factorize(const Eigen::MatrixXd& A) { factors_.compute(A); }

void Lu::solve(Eigen::MatrixXd& B) const {
  B = factors_.permutationP() * B;
  factors_.matrixLU().triangularView<Eigen::UnitLower>().solveInPlace(B);
  factors_.matrixLU().triangularView<Eigen::Upper>().solveInPlace(B);
}

}  // namespace latsch::numerics
