// SPDX-License-Identifier: Apache-2.0
// A slope from values beside a point, and how far it may be off: differences at several steps,
// extrapolated to a step of zero.
//
// Central differences err by even powers of the step, one-sided ones by all. Each extrapolation
// removes one of them and enlarges what the values are off; of all of them that one is taken whose
// estimated error is least: the larger of its distance to its two predecessors and of the noise in
// it. [Ridders, Accurate computation of F'(x) and F'(x) F''(x), Adv. Eng. Software 4 (1982) 75-76]
#pragma once

#include <optional>
#include <vector>

namespace latsch::benchmarks {

struct ExtrapolatedSlope {
  double value = 0.0, error = 0.0;  // estimated
  bool one_sided = false;
};

/// Values at the point minus and plus a step; none where they belong to another branch.
struct StepValues {
  double step = 0.0;
  std::optional<double> below, above;
};

/// `steps` descending; `at`: the value at the point; `noise`: what values may be off. Of both sides
/// where at least three steps have both, else of that side which has three; else nothing.
std::optional<ExtrapolatedSlope> extrapolated_slope(const std::vector<StepValues>& steps,
                                                    double at,
                                                    double noise);

}  // namespace latsch::benchmarks
