// SPDX-License-Identifier: Apache-2.0
#include "optimization/flat_directions.h"

#include <Eigen/SVD>

namespace latsch {
namespace {

constexpr double kFelt = 1e-6;  // of the residuals: well above their rounding, below any use

}  // namespace

Eigen::MatrixXd flat_directions(const Eigen::MatrixXd& J, double length, double r) {
  if (!J.allFinite()) return Eigen::MatrixXd(J.cols(), 0);
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(J, Eigen::ComputeFullV);
  Eigen::Index felt = 0;  // singular values descend; behind the last of them are zeros
  while (felt < svd.singularValues().size() && svd.singularValues()[felt] * length > kFelt * r) {
    ++felt;
  }
  return svd.matrixV().rightCols(J.cols() - felt);
}

bool is_same(const Eigen::VectorXd& r, const Eigen::VectorXd& other) {
  return (r - other).norm() <= kFelt * other.norm();
}

}  // namespace latsch
