// SPDX-License-Identifier: Apache-2.0
#include "numerics/dense/lu.h"

#include <Eigen/LU>

namespace latsch::numerics {

Lu::Lu(const Eigen::MatrixXd& A) {
  const Eigen::PartialPivLU<Eigen::MatrixXd> factors(A);
  LU_ = factors.matrixLU();
  row_ = Eigen::PermutationMatrix<Eigen::Dynamic>(factors.permutationP().inverse()).indices();
}

Eigen::MatrixXd Lu::solve(const Eigen::MatrixXd& B) const {
  Eigen::MatrixXd x = B(row_, Eigen::all);
  LU_.triangularView<Eigen::UnitLower>().solveInPlace(x);
  LU_.triangularView<Eigen::Upper>().solveInPlace(x);
  return x;
}

}  // namespace latsch::numerics
