// SPDX-License-Identifier: Apache-2.0
#include "optimization/least_squares/residual_curvature.h"

namespace latsch {

Eigen::VectorXd residual_curvature(const Slopes& at,
                                   const Slopes& other,
                                   const Eigen::VectorXd& p) {
  const Eigen::VectorXd s = at.u - other.u;
  const double a = s.dot(p) / s.squaredNorm();
  const Eigen::VectorXd q = p - a * s;
  const Eigen::VectorXd Tss =
      6.0 * (other.r - at.r) + 4.0 * (at.J * s) + 2.0 * (other.J * s);  // (1)
  const Eigen::VectorXd Tsq = at.J * q - other.J * q;
  return 0.5 * a * a * Tss + a * Tsq;  // (2)
}

}  // namespace latsch
