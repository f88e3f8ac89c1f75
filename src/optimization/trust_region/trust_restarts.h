// SPDX-License-Identifier: Apache-2.0
// Restarts of a residual trust region: the conditions for a restart, and its first point.
// residual_trust_region.h describes them.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>

#include "optimization/trust_region/residual_trust_region.h"
#include "optimization/trust_region/trust_box.h"
#include "optimization/trust_region/trust_region_tuning.h"

namespace latsch {

class TrustRestarts {
 public:
  explicit TrustRestarts(const RestartTuning& tuning) : tuning_(tuning) {}

  /// Number of restarts so far.
  int count() const { return count_; }
  /// True if the start being evaluated is one of the single points along flat directions.
  bool is_scouting() const { return is_scouting_; }

  /// False if no restart is left, if the region is a single point, or if noise explains the whole
  /// remaining error.
  bool may_follow(TrustBox& box, const ResidualTrustRegionOptions& options);
  /// True if the remaining value is only a tiny share of the first value and of the increase in the
  /// neighborhood of the best point. If noise is stated, noise alone decides.
  bool is_explained(double f_best, double f_first, const ResidualTrustRegionOptions& options) const;
  /// True if the value is clearly better than when the run last settled: it has to settle again
  /// before the restart.
  bool is_worth_a_look(double f_best);
  /// Finds the directions along which no residual changes at the best point. The next restart
  /// evaluates points along them first.
  void find_flat_directions(TrustBox& box, double initial_radius);

  /// Returns a start at which the variables that ended on a bound are moved to the middle of their
  /// ranges. This is done once for each best point whose value is at least `f_least`; otherwise,
  /// and if no variable is on a bound, the result is nullopt.
  std::optional<Wanted> release(TrustBox& box, double initial_radius, double f_least);
  /// Begins a restart at the next distance from the best point.
  Wanted begin(TrustBox& box, const ResidualTrustRegionOptions& options);
  /// Returns a start near the best point, along flat directions as long as such points are left.
  Wanted start(TrustBox& box, double initial_radius);

 private:
  RestartTuning tuning_;
  int count_ = 0;
  // Increase of f over a move by the initial radius from the best point, computed when it was last
  // the center.
  double rise_ = 0.0;
  /// Best value when the run last settled.
  double f_settled_ = std::numeric_limits<double>::infinity();
  /// Best value when variables on bounds were last released.
  double f_released_ = std::numeric_limits<double>::infinity();
  Eigen::MatrixXd flat_;  // columns: directions without effect at the best point
  /// Number of points along these directions that are left in this restart.
  int scouts_ = 0;
  /// True if the start being evaluated is one of the points along flat directions.
  bool is_scouting_ = false;
};

}  // namespace latsch
