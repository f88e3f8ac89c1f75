// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/steady_rolling.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace latsch::experiment {

void FallingRange::add(double force) {
  low_ = is_empty_ ? force : std::min(low_, force);
  high_ = is_empty_ ? force : std::max(high_, force);
  is_empty_ = false;
}

bool FallingRange::has_settled(double share, double least) {
  ranges_.push_back(high_ - low_);
  is_empty_ = true;
  if (ranges_.size() < 4) return false;
  const auto last = ranges_.end();
  const double before = std::max(last[-4], last[-3]), now = std::max(last[-2], last[-1]);
  return before - now <= share * now + least;
}

// Means over a turn, half a turn apart, approach the limit as a geometric series does:
// e_k = e_0 q^k, so d_k = e_{k-1} - e_k and e_k = d_k q/(1 - q).
double left_to_limit(std::span<const double> values, std::size_t turn) {
  assert(turn >= 2 && values.size() >= 2 * turn);
  const auto mean = [&](std::size_t behind) {  // mean of the turn that ends `behind` samples ago
    const auto end = values.end() - static_cast<std::ptrdiff_t>(behind);
    return std::accumulate(end - static_cast<std::ptrdiff_t>(turn), end, 0.0) /
           static_cast<double>(turn);
  };
  const double first = mean(turn), middle = mean(turn / 2), last = mean(0);
  const double before = std::abs(middle - first), now = std::abs(last - middle);
  if (now >= before) return now;  // no approach: a ripple, or rounding
  const double q = now / before;
  return now * q / (1.0 - q);
}

}  // namespace latsch::experiment
