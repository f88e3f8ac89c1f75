// SPDX-License-Identifier: Apache-2.0
// Orthogonal factors of dense m x n matrices by Householder reflections, from Eigen, compiled here
// once for all users.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace latsch::numerics {

/// Factorization A = Q R with m >= n, for columns known to be independent.
class HouseholderQr {
 public:
  explicit HouseholderQr(const Eigen::MatrixXd& A);

  Eigen::MatrixXd Q() const;                                           // m x m
  Eigen::MatrixXd R() const;                                           // n x n
  Eigen::VectorXd times_Q(const Eigen::VectorXd& b) const;             // Q b
  Eigen::VectorXd times_Q_transposed(const Eigen::VectorXd& b) const;  // Q' b
  Eigen::VectorXd solve_R(const Eigen::VectorXd& b) const;             // R^-1 (b_1 ... b_n)

 private:
  Eigen::MatrixXd reflections_;   // Householder vectors, and R above the diagonal
  Eigen::VectorXd coefficients_;  // 2 / |reflection|^2
};

/// Factorization A P = Q R with column pivoting: each next column is the one farthest from the span
/// of the columns before it, so that the diagonal of R reveals the rank.
struct PivotedQr {
  Eigen::MatrixXd Q;       // m x m: the first `rank` columns span the range
  std::vector<int> order;  // order of the n columns: the first `rank` are independent
  int rank = 0;
};

/// Treats a pivot below `threshold` times the largest one as zero.
PivotedQr pivoted_qr(const Eigen::MatrixXd& A, double threshold);

/// Returns orthonormal columns that span the range of A to rounding.
Eigen::MatrixXd range_basis(const Eigen::MatrixXd& A);

/// Returns the x that minimizes |A x - b|, for A with independent columns.
Eigen::VectorXd least_squares_solution(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// Returns the shortest of all x that minimize |A x - b|, for A of any shape and rank. B is treated
/// column by column.
Eigen::VectorXd shortest_solution(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);
Eigen::MatrixXd shortest_solution(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

}  // namespace latsch::numerics
