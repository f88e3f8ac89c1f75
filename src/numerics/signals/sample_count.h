// SPDX-License-Identifier: Apache-2.0
// Length of a part of a record, stated by a user in seconds, as a number of samples.
#pragma once

#include <algorithm>
#include <cmath>

namespace latsch::numerics {

/// A number of samples larger than that of any record. Sums of four such counts still fit into an
/// int.
inline constexpr int kMostSampleCount = 500'000'000;

/// Returns the rounded number of samples in `seconds` at `rate` samples per second, at most
/// kMostSampleCount. A time longer than any record thus stays longer than any record, and the
/// caller that compares the count with the samples of a record refuses it. `seconds` and `rate` are
/// at least 0.
inline int sample_count(double seconds, double rate) {
  return static_cast<int>(
      std::lround(std::min(seconds * rate, static_cast<double>(kMostSampleCount))));
}

}  // namespace latsch::numerics
