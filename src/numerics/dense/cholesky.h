// SPDX-License-Identifier: Apache-2.0
// Cholesky factors of dense symmetric matrices, from Eigen, compiled here once for all users. For
// sparse matrices see factorization.h.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace latsch::numerics {

/// Factorization A = L L' of a positive definite n x n matrix. Only the lower triangle of A is
/// read.
class Cholesky {
 public:
  explicit Cholesky(const Eigen::MatrixXd& A);

  /// If false, there is no factor, and the functions below must not be called.
  bool is_positive_definite() const { return is_positive_definite_; }
  /// Returns L, n x n, with zeros above the diagonal.
  const Eigen::MatrixXd& L() const { return L_; }
  double log_determinant() const;  // ln det A

  /// Returns A^-1 b.
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  /// Return L^-1 b and L'^-1 b.
  Eigen::VectorXd solve_lower(const Eigen::VectorXd& b) const;
  Eigen::MatrixXd solve_lower(const Eigen::MatrixXd& B) const;
  Eigen::VectorXd solve_upper(const Eigen::VectorXd& b) const;

 private:
  Eigen::MatrixXd L_;
  bool is_positive_definite_;
};

/// Factorization A = P' L D L' P with the largest diagonal first, for matrices that are
/// semidefinite or not clearly definite. Components of vanishing pivots are left at zero.
class PivotedCholesky {
 public:
  PivotedCholesky() = default;
  explicit PivotedCholesky(const Eigen::MatrixXd& A);

  /// Returns A^-1 b.
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  Eigen::MatrixXd solve(const Eigen::MatrixXd& B) const;

 private:
  // It begins with an empty matrix, because a copy of a factor that was never made is undefined.
  Eigen::LDLT<Eigen::MatrixXd> factors_{Eigen::MatrixXd(0, 0)};
};

}  // namespace latsch::numerics
