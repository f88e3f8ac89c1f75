// SPDX-License-Identifier: Apache-2.0
#include "optimization/problem/score.h"

#include <algorithm>
#include <cmath>

namespace latsch {

double violation(const Score& score) {
  double worst = 0.0;
  for (const double c : score.constraints) worst = std::max(worst, c);
  for (const double h : score.equations) worst = std::max(worst, std::abs(h));
  return worst;
}

bool is_better(const Score& a, const Score& b) {
  const double over_a = std::max(violation(a), kFulfilled);
  const double over_b = std::max(violation(b), kFulfilled);
  return over_a != over_b ? over_a < over_b : a.value < b.value;
}

}  // namespace latsch
