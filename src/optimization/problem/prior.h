// SPDX-License-Identifier: Apache-2.0
// Prior knowledge of a variable before anything is fitted: a value and its standard deviation. The
// prior counts as a measurement of the variable itself and adds one residual, in units of its
// standard deviation:
//   r = (x - value) / sigma
//   r = ln(x / value) / ln(1 + sigma)    if the variable is logarithmic and sigma is a share of
//                                        the value
// [Tarantola, Inverse Problem Theory, 2005, ch. 3.2]
#pragma once

#include <cmath>

namespace latsch {

struct Prior {
  double value = 0.0;         // SI
  double sigma = 1.0;         // SI; if `of_logarithm` is true, a share of the value
  bool of_logarithm = false;  // true if sigma is the deviation of the logarithm

  /// Returns the residual of the value x (SI), in units of its standard deviation.
  double residual(double x) const {
    return of_logarithm ? std::log(x / value) / std::log1p(sigma) : (x - value) / sigma;
  }
  /// Returns the derivative of the residual with respect to x.
  double slope(double x) const { return 1.0 / (of_logarithm ? x * std::log1p(sigma) : sigma); }
  bool operator==(const Prior&) const = default;
};

}  // namespace latsch
