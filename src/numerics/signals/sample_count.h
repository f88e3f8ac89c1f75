// SPDX-License-Identifier: Apache-2.0
// Length of a part of a record, stated by a user in seconds, as a number of samples.
#pragma once

#include <algorithm>
#include <cmath>

namespace latsch::numerics {

/// Larger than the samples of any record; sums of four such counts are still integers.
inline constexpr int kMostSampleCount = 500'000'000;

/// Returns the samples in `seconds`, rounded, at `rate` samples a second; at most
/// kMostSampleCount. So a time longer than any record stays longer than each, and is refused where
/// the count is compared with the samples of a record. `seconds` and `rate` are at least 0.
inline int sample_count(double seconds, double rate) {
  return static_cast<int>(
      std::lround(std::min(seconds * rate, static_cast<double>(kMostSampleCount))));
}

}  // namespace latsch::numerics
