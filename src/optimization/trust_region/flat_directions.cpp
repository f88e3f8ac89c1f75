// SPDX-License-Identifier: Apache-2.0
#include "optimization/trust_region/flat_directions.h"

#include "numerics/dense/singular_values.h"

namespace latsch {
namespace {

constexpr double kFelt = 1e-6;  // share of the residuals: well above their rounding, below any use

}  // namespace

Eigen::MatrixXd flat_directions(const Eigen::MatrixXd& J, double length, double r) {
  if (!J.allFinite()) return Eigen::MatrixXd(J.cols(), 0);
  const auto [values, V] = numerics::singular_values(J);
  Eigen::Index felt = 0;  // singular values descend; zeros follow the last of them
  while (felt < values.size() && values[felt] * length > kFelt * r) ++felt;
  return V.rightCols(J.cols() - felt);
}

bool is_same(const Eigen::VectorXd& r, const Eigen::VectorXd& other) {
  return (r - other).norm() <= kFelt * other.norm();
}

}  // namespace latsch
