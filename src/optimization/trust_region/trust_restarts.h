// SPDX-License-Identifier: Apache-2.0
// Restarts of a residual trust region: whether one follows, and where it begins. The head of
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

  /// False if no restart is left, if there is nothing to vary, or if noise explains the whole
  /// remaining error.
  bool may_follow(TrustBox& box, const ResidualTrustRegionOptions& options);
  /// True if the remaining value is almost nothing of the first one and of its increase beside the
  /// best point. If noise is stated, noise alone decides.
  bool is_explained(double f_best, double f_first, const ResidualTrustRegionOptions& options) const;
  /// True if the value is clearly better than at the last time: the run has to settle first.
  bool is_worth_a_look(double f_best);
  /// Finds the directions without effect at the best point, along which the next restart scouts.
  void find_flat_directions(TrustBox& box, double initial_radius);

  /// Moves variables that ended on a bound to the middle of their ranges, once for each best point
  /// with a value of at least `f_least`. Returns nullopt if there are none.
  std::optional<Wanted> release(TrustBox& box, double initial_radius, double f_least);
  /// Starts beside the best point at the next distance.
  Wanted begin(TrustBox& box, const ResidualTrustRegionOptions& options);
  /// Starts beside the best point, along flat directions as long as scouts are left.
  Wanted start(TrustBox& box, double initial_radius);

 private:
  RestartTuning tuning_;
  int count_ = 0;
  // Increase of f at an initial radius off the best point, from the last time it was the center.
  double rise_ = 0.0;
  double f_settled_ = std::numeric_limits<double>::infinity();   // best value when the run settled
  double f_released_ = std::numeric_limits<double>::infinity();  // best value at the last release
  Eigen::MatrixXd flat_;      // directions without effect at the best point of all
  int scouts_ = 0;            // number of points along these directions left in this restart
  bool is_scouting_ = false;  // the start being evaluated is a scout
};

}  // namespace latsch
