// SPDX-License-Identifier: Apache-2.0
// A rational function of s as a filter of samples by the bilinear transform,
//
//   s = K (1 - 1/z) / (1 + 1/z),      K = 2 rate,  or  w / tan(w / (2 rate))
//
// A stable function stays stable. Frequencies are compressed: w of the filter answers as 2 rate
// tan(w / (2 rate)) of the function, exact at 0 and, with the second K, at w as well.
#pragma once

#include <vector>

#include "numerics/signals/digital_filter.h"

namespace latsch::numerics {

/// b(s)/a(s), coefficients from the constant upward; the degree of b is not above that of a.
struct ContinuousFilter {
  std::vector<double> b, a;
};

/// `exact_at`: rad/s, 0 or a frequency below pi rate at which the answer is exact.
RationalFilter bilinear(const ContinuousFilter& filter, double rate, double exact_at = 0.0);

}  // namespace latsch::numerics
