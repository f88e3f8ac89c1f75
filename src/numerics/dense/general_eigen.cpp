// SPDX-License-Identifier: Apache-2.0
#include "numerics/dense/general_eigen.h"

#include <Eigen/Eigenvalues>

namespace latsch::numerics {

std::optional<GeneralEigen> general_eigen(const Eigen::MatrixXd& A) {
  if (!A.allFinite()) return std::nullopt;
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(A);
  if (solver.info() != Eigen::Success) return std::nullopt;
  return GeneralEigen{solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace latsch::numerics
