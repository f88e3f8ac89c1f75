// SPDX-License-Identifier: Apache-2.0
// Orthogonal factors of dense m x n matrices by Householder reflections: Eigen's, compiled here
// once for all who ask.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace latsch::numerics {

/// A = Q R with m >= n; for columns known to be independent.
class HouseholderQr {
 public:
  explicit HouseholderQr(const Eigen::MatrixXd& A);

  Eigen::MatrixXd Q() const;                                           // m x m
  Eigen::MatrixXd R() const;                                           // n x n
  Eigen::VectorXd times_Q(const Eigen::VectorXd& b) const;             // Q b
  Eigen::VectorXd times_Q_transposed(const Eigen::VectorXd& b) const;  // Q' b
  Eigen::VectorXd solve_R(const Eigen::VectorXd& b) const;             // R^-1 (b_1 ... b_n)

 private:
  Eigen::MatrixXd reflections_;   // R above them
  Eigen::VectorXd coefficients_;  // 2 / |reflection|^2
};

/// A P = Q R, the column farthest from those before it next: shows the rank.
struct PivotedQr {
  Eigen::MatrixXd Q;       // m x m: the first `rank` columns span the range
  std::vector<int> order;  // of the n columns: the first `rank` are independent
  int rank = 0;
};

/// A pivot below threshold times the largest one counts as zero.
PivotedQr pivoted_qr(const Eigen::MatrixXd& A, double threshold);

/// Orthonormal columns that span the range of A, told from rounding.
Eigen::MatrixXd range_basis(const Eigen::MatrixXd& A);

/// The x of least |A x - b| for A whose columns are independent.
Eigen::VectorXd least_squares_solution(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// Of all x of least |A x - b| the shortest: A of any shape and rank. B: column by column.
Eigen::VectorXd shortest_solution(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);
Eigen::MatrixXd shortest_solution(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

}  // namespace latsch::numerics
