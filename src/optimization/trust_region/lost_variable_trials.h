// SPDX-License-Identifier: Apache-2.0
// The strategy around a run of the residual trust region: where it settles, lost variables are
// looked for (lost_variables.h). From every place where they are felt again a trial run of
// 3 (n + 1) evaluations starts afresh, and the best of the trials and the run goes on. The trials
// count as restarts unless they brought a clearly better value.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "optimization/trust_region/lost_variables.h"
#include "optimization/trust_region/trust_region_run.h"

namespace latsch {

class LostVariableTrials {
 public:
  LostVariableTrials(const DesignSpace& space, const ResidualTrustRegionOptions& options)
      : run_(space, options) {}

  /// The run that goes on, whatever trials are under way.
  const TrustRegionRun& run() const { return run_; }
  /// Of it or of the trial in its place; empty: ended.
  const PendingPoints<Wanted>& wanted() const;
  /// As TrustRegionRun::observe.
  void observe(const DesignPoint& point,
               const Eigen::VectorXd& u,
               const std::optional<ResidualSample>& sample);
  /// By which idle workers are sent ahead: what the models predict, and of a look for lost
  /// variables that it tells nothing.
  ResidualSample expected(const DesignPoint& point) const;
  /// Wants `count` points at a time from here on.
  void widen(int count) { run_.widen(count); }

 private:
  void look_further();
  void take_look(const DesignPoint& point, const std::optional<ResidualSample>& sample);
  void start_trial(const DesignPoint& point, const ResidualSample& sample, double factor);
  void choose();

  TrustRegionRun run_;
  std::optional<LostVariables> lost_;   // while they are looked for
  Eigen::VectorXd r_settled_;           // where the run settled
  PendingPoints<Wanted> look_;          // the next point of `lost_`; at most one
  std::vector<TrustRegionRun> trials_;  // from the places where they are felt
  int allotted_ = 0;                    // evaluations left to the last of them
};

}  // namespace latsch
