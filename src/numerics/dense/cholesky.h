// SPDX-License-Identifier: Apache-2.0
// Cholesky factors of dense symmetric matrices: Eigen's, compiled here once for all who ask.
// Sparse matrices: factorization.h.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace latsch::numerics {

/// A = L L' of a positive definite n x n matrix; only the lower triangle of A is read.
class Cholesky {
 public:
  explicit Cholesky(const Eigen::MatrixXd& A);

  /// False: there is no factor, and nothing below may be asked.
  bool is_positive_definite() const { return is_positive_definite_; }
  /// n x n, zeros above the diagonal.
  const Eigen::MatrixXd& L() const { return L_; }
  double log_determinant() const;  // of A

  /// A^-1 b
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  /// L^-1 b and L'^-1 b
  Eigen::VectorXd solve_lower(const Eigen::VectorXd& b) const;
  Eigen::MatrixXd solve_lower(const Eigen::MatrixXd& B) const;
  Eigen::VectorXd solve_upper(const Eigen::VectorXd& b) const;

 private:
  Eigen::MatrixXd L_;
  bool is_positive_definite_;
};

/// A = P' L D L' P with the largest diagonal first: for matrices that are semidefinite, or not
/// clearly definite; what belongs to vanishing pivots is left at zero.
class PivotedCholesky {
 public:
  PivotedCholesky() = default;
  explicit PivotedCholesky(const Eigen::MatrixXd& A);

  /// A^-1 b
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  Eigen::MatrixXd solve(const Eigen::MatrixXd& B) const;

 private:
  Eigen::LDLT<Eigen::MatrixXd> factors_;
};

}  // namespace latsch::numerics
