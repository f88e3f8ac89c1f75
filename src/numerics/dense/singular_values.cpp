// SPDX-License-Identifier: Apache-2.0
#include "numerics/dense/singular_values.h"

#include <Eigen/SVD>

namespace latsch::numerics {

SingularValues singular_values(const Eigen::MatrixXd& J) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(J, Eigen::ComputeFullV);
  return {svd.singularValues(), svd.matrixV()};
}

}  // namespace latsch::numerics
