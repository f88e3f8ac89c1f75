// SPDX-License-Identifier: Apache-2.0
// Determines when a rolling tire has become steady. A tire whose slips follow the wheel over a
// length σ needs a distance of several σ, and a free wheel on such a tire oscillates and comes to
// rest over 2 σ.
#pragma once

#include <span>
#include <vector>

namespace latsch::experiment {

/// Distance, m, over which a tire that is not yet steady is rolled before the test fails.
constexpr double kFarthestToSteady = 400.0;

/// Range (greatest minus least value) of a force over successive stretches of road. It falls during
/// a transient and then stays constant if the tire itself makes the force vary at every turn. The
/// larger ranges of two pairs of stretches are compared, because a slow oscillation may be at its
/// turning point during one stretch.
class FallingRange {
 public:
  void add(double force);
  /// Ends a stretch and begins the next. Returns true if the range fell by less than `share` of
  /// itself plus `least`, N; false during the first three stretches.
  bool has_settled(double share, double least);

 private:
  double low_ = 0.0, high_ = 0.0;
  bool is_empty_ = true;
  std::vector<double> ranges_;  // ranges of the stretches that have ended
};

/// Returns how far the mean over the last `turn` samples still is from its limit, if the values
/// approach a limit as exp(-x/σ) does; values that only vary within a turn do not count. It needs
/// at least 2 `turn` values.
double left_to_limit(std::span<const double> values, std::size_t turn);

}  // namespace latsch::experiment
