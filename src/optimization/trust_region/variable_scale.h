// SPDX-License-Identifier: Apache-2.0
// How far each variable may go in a step, from what the residuals feel of it.
//
//   w_i = (g / D_i)^(1/2),      D_i = max over centers of |dr/du_i|,     g: geometric mean of D
//
// Moré's scale, 1 / D_i, makes all variables move the residuals alike. It trusts the Jacobian
// alone: where a variable is without effect here but not there, it goes far astray. The cube of the
// design space, w_i = 1, trusts the user's ranges alone. This is the geometric mean of both.
// [Moré, in: Numerical Analysis, Lecture Notes in Mathematics 630 (1978) 105]
#pragma once

#include <Eigen/Core>

namespace latsch {

class VariableScale {
 public:
  /// All widths 1.
  explicit VariableScale(int n);

  /// Takes in the Jacobian dr/du at another center. One that is not finite or zero is ignored.
  void learn(const Eigen::MatrixXd& J);

  /// w; product 1.
  const Eigen::VectorXd& widths() const { return widths_; }
  /// The largest component of du / w.
  double length(const Eigen::VectorXd& du) const;
  /// du / w, in the Euclidean norm.
  double norm(const Eigen::VectorXd& du) const;

 private:
  Eigen::VectorXd largest_;  // D
  Eigen::VectorXd widths_;
};

}  // namespace latsch
