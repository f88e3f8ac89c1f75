// SPDX-License-Identifier: Apache-2.0
#include "numerics/dense/cholesky.h"

namespace latsch::numerics {

Cholesky::Cholesky(const Eigen::MatrixXd& A) {
  const Eigen::LLT<Eigen::MatrixXd> factors(A);
  is_positive_definite_ = factors.info() == Eigen::Success;
  L_ = factors.matrixL();
}

double Cholesky::log_determinant() const { return 2.0 * L_.diagonal().array().log().sum(); }

Eigen::VectorXd Cholesky::solve(const Eigen::VectorXd& b) const {
  return solve_upper(solve_lower(b));
}

Eigen::VectorXd Cholesky::solve_lower(const Eigen::VectorXd& b) const {
  return L_.triangularView<Eigen::Lower>().solve(b);
}

Eigen::MatrixXd Cholesky::solve_lower(const Eigen::MatrixXd& B) const {
  return L_.triangularView<Eigen::Lower>().solve(B);
}

Eigen::VectorXd Cholesky::solve_upper(const Eigen::VectorXd& b) const {
  return L_.transpose().triangularView<Eigen::Upper>().solve(b);
}

PivotedCholesky::PivotedCholesky(const Eigen::MatrixXd& A) : factors_(A) {}

Eigen::VectorXd PivotedCholesky::solve(const Eigen::VectorXd& b) const { return factors_.solve(b); }

Eigen::MatrixXd PivotedCholesky::solve(const Eigen::MatrixXd& B) const { return factors_.solve(B); }

}  // namespace latsch::numerics
