// SPDX-License-Identifier: Apache-2.0
// Relative step length of each variable, from the effect of the variable on the residuals.
//
//   w_i = b_i (g / D_i)^(1/2),      D_i = max over centers of b_i |dr/du_i|,     g: geometric mean
//
// Moré's scale, 1 / D_i, makes a step in any variable change the residuals equally. It relies on
// the Jacobian alone: a variable with no effect at one point may then move much too far. The base
// widths b rely on the user alone: 1, the whole range, or less if the bounds are far from any
// value. This scale is the geometric mean of both.
// [Moré, in: Numerical Analysis, Lecture Notes in Mathematics 630 (1978) 105]
#pragma once

#include <Eigen/Core>

namespace latsch {

class VariableScale {
 public:
  /// Begins with the base widths as widths: shares of the ranges, above 0 and at most 1.
  explicit VariableScale(const Eigen::VectorXd& base);

  /// Makes every base width at least as large as the given one.
  void widen(const Eigen::VectorXd& base);

  /// Uses the Jacobian dr/du at another center. A Jacobian that is not finite or zero is ignored.
  void learn(const Eigen::MatrixXd& J);

  /// Returns w; the product of its entries is that of the base widths.
  const Eigen::VectorXd& widths() const { return widths_; }
  /// Returns the largest component of du / w.
  double length(const Eigen::VectorXd& du) const;
  /// Returns the Euclidean norm of du / w.
  double norm(const Eigen::VectorXd& du) const;

 private:
  void update();

  Eigen::VectorXd base_;     // b
  Eigen::VectorXd largest_;  // largest |dr/du_i|
  Eigen::VectorXd widths_;
};

}  // namespace latsch
