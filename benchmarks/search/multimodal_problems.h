// SPDX-License-Identifier: Apache-2.0
// Sums of squares with several minima, of kinds that fits of recordings have: frequencies over wide
// ranges, pairs of modes, ripple, phases, peaks. All are exact at their true values, which a seed
// draws together with the start.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "optimization/problem/design_space.h"

namespace latsch::benchmarks {

struct MultimodalProblem {
  std::string name;
  DesignSpace space;
  std::function<std::vector<double>(const std::vector<double>&)> residuals;
  std::vector<double> truth;
  int n() const { return space.size(); }
};

inline constexpr int kMultimodalKinds = 12;  // even kinds are for tuning, odd ones for judging

/// Returns the problem of a kind, 0 to kMultimodalKinds - 1, with true values and a start drawn by
/// the seed.
MultimodalProblem multimodal_problem(int kind, std::uint64_t seed);

}  // namespace latsch::benchmarks
