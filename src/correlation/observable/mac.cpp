// SPDX-License-Identifier: Apache-2.0
#include "correlation/observable/mac.h"

#include <algorithm>
#include <cassert>

#include "numerics/dense/orthogonal_factors.h"

namespace latsch::correlation {

double mac(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  assert(A.rows() == B.rows());
  const Eigen::MatrixXd Q_A = numerics::range_basis(A), Q_B = numerics::range_basis(B);
  const auto dimension = std::min(Q_A.cols(), Q_B.cols());
  if (dimension == 0) return 0.0;
  return (Q_A.transpose() * Q_B).squaredNorm() / static_cast<double>(dimension);
}

}  // namespace latsch::correlation
