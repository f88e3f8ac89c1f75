// SPDX-License-Identifier: Apache-2.0
// P A = L U of a dense square matrix by partial pivoting: Eigen's, compiled here once for all who
// ask.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

namespace latsch::numerics {

/// Keeps its memory from one matrix to the next.
class Lu {
 public:
  /// n x n, not singular.
  void factorize(const Eigen::MatrixXd& A);

  /// B <- A^-1 B, column by column.
  void solve(Eigen::MatrixXd& B) const;

 private:
  Eigen::PartialPivLU<Eigen::MatrixXd> factors_;
};

}  // namespace latsch::numerics
