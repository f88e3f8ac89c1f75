// SPDX-License-Identifier: Apache-2.0
// Prior knowledge of a variable before anything is fitted: a value and its standard deviation. The
// prior counts as a measurement of the variable itself and adds one residual:
//   r = (x - value) / sigma                    or, if sigma is a share of the value and the
//   r = ln(x / value) / ln(1 + sigma)          variable is logarithmic,
// in units of its noise like the other residuals. [Tarantola, Inverse Problem Theory, 2005, ch.
// 3.2]
#pragma once

#include <cmath>

namespace latsch {

struct Prior {
  double value = 0.0;         // SI
  double sigma = 1.0;         // SI; for a logarithm a share of the value
  bool of_logarithm = false;  // true: the deviation is that of the logarithm

  /// Returns the residual of the value x (SI), in units of its standard deviation.
  double residual(double x) const {
    return of_logarithm ? std::log(x / value) / std::log1p(sigma) : (x - value) / sigma;
  }
  /// Returns d residual / dx.
  double slope(double x) const { return 1.0 / (of_logarithm ? x * std::log1p(sigma) : sigma); }
  bool operator==(const Prior&) const = default;
};

}  // namespace latsch
