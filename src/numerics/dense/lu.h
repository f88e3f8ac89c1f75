// SPDX-License-Identifier: Apache-2.0
// Factorization P A = L U of a dense square matrix by partial pivoting, from Eigen, compiled here
// once for all users.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

namespace latsch::numerics {

/// An LU factorization whose memory is reused for the next matrix.
class Lu {
 public:
  /// Factorizes A, n x n, which must not be singular.
  void factorize(const Eigen::MatrixXd& A);

  /// Computes B <- A^-1 B, column by column.
  void solve(Eigen::MatrixXd& B) const;

 private:
  Eigen::PartialPivLU<Eigen::MatrixXd> factors_;
};

}  // namespace latsch::numerics
