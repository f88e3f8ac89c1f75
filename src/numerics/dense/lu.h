// SPDX-License-Identifier: Apache-2.0
// P A = L U of a dense square matrix by partial pivoting: Eigen's, compiled here once for all who
// ask.
#pragma once

#include <Eigen/Core>

namespace latsch::numerics {

class Lu {
 public:
  /// n x n, not singular.
  explicit Lu(const Eigen::MatrixXd& A);

  /// A^-1 B, column by column.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& B) const;

 private:
  Eigen::MatrixXd LU_;   // ones on the diagonal of L
  Eigen::VectorXi row_;  // of A, first in P A
};

}  // namespace latsch::numerics
