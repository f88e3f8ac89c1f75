// SPDX-License-Identifier: Apache-2.0
// Relative step length of each variable, from the effect of the variable on the residuals.
//
//   w_i = (g / D_i)^(1/2),      D_i = max over centers of |dr/du_i|,     g: geometric mean of D
//
// Moré's scale, 1 / D_i, makes a step in any variable change the residuals equally. It relies on
// the Jacobian alone: a variable with no effect at one point may then move much too far. The cube
// of the design space, w_i = 1, relies on the user's ranges alone. This scale is the geometric mean
// of both. [Moré, in: Numerical Analysis, Lecture Notes in Mathematics 630 (1978) 105]
#pragma once

#include <Eigen/Core>

namespace latsch {

class VariableScale {
 public:
  /// Begins with widths of 1.
  explicit VariableScale(int n);

  /// Uses the Jacobian dr/du at another center. A Jacobian that is not finite or zero is ignored.
  void learn(const Eigen::MatrixXd& J);

  /// Returns w; the product of its entries is 1.
  const Eigen::VectorXd& widths() const { return widths_; }
  /// Returns the largest component of du / w.
  double length(const Eigen::VectorXd& du) const;
  /// Returns the Euclidean norm of du / w.
  double norm(const Eigen::VectorXd& du) const;

 private:
  Eigen::VectorXd largest_;  // D
  Eigen::VectorXd widths_;
};

}  // namespace latsch
