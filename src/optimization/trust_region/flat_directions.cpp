// SPDX-License-Identifier: Apache-2.0
#include "optimization/trust_region/flat_directions.h"

#include "numerics/dense/singular_values.h"

namespace latsch {
namespace {

// Effect on the residuals, as a share of their norm, below which a direction counts as flat. It is
// well above rounding errors and far below any effect of practical use.
constexpr double kFelt = 1e-6;

}  // namespace

Eigen::MatrixXd flat_directions(const Eigen::MatrixXd& J, double length, double r) {
  if (!J.allFinite()) return Eigen::MatrixXd(J.cols(), 0);
  const auto [values, V] = numerics::singular_values(J);
  // The number of directions with an effect. Singular values descend, and those missing at the end
  // are zero.
  Eigen::Index felt = 0;
  while (felt < values.size() && values[felt] * length > kFelt * r) ++felt;
  return V.rightCols(J.cols() - felt);
}

bool is_same(const Eigen::VectorXd& r, const Eigen::VectorXd& other) {
  return (r - other).norm() <= kFelt * other.norm();
}

}  // namespace latsch
