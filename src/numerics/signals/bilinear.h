// SPDX-License-Identifier: Apache-2.0
// Bilinear transform of a rational function of s to a filter of samples,
//
//   s = K (1 - 1/z) / (1 + 1/z),      K = 2 rate,  or  w / tan(w / (2 rate))
//
// A stable function gives a stable filter. Frequencies are compressed: the filter has at w the
// response of the function at 2 rate tan(w / (2 rate)). It is exact at 0 and, with the second K, at
// w too.
#pragma once

#include <vector>

#include "numerics/signals/digital_filter.h"

namespace latsch::numerics {

/// Rational function b(s)/a(s) with coefficients from the constant upward. The degree of b must not
/// exceed that of a.
struct ContinuousFilter {
  std::vector<double> b, a;
};

/// Returns the filter for samples at `rate`, Hz. `exact_at` is the frequency at which its response
/// is exact, rad/s: 0, or a frequency below pi rate.
RationalFilter bilinear(const ContinuousFilter& filter, double rate, double exact_at = 0.0);

}  // namespace latsch::numerics
