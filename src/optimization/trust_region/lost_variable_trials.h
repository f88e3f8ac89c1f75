// SPDX-License-Identifier: Apache-2.0
// Extends a run of the residual trust region by a search for lost variables, which have no effect
// on the residuals (lost_variables.h), whenever the run settles. From every point at which they
// have an effect again, a trial run of 3 (n + 1) evaluations starts afresh, and the best of the
// trials and the run continues. The trials count as restarts unless they brought a clearly better
// value.
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
      : run_(space, options) {
    run_.set_tests_end(options.tests_end);
  }

  /// Returns the main run, even while trials are in progress.
  const TrustRegionRun& run() const { return run_; }
  /// Returns the wanted points of the main run or of the present trial; empty if the search has
  /// ended.
  const PendingPoints<Wanted>& wanted() const;
  /// Receives the outcome of a point, as TrustRegionRun::observe does.
  void observe(const DesignPoint& point,
               const Eigen::VectorXd& u,
               const std::optional<ResidualSample>& sample);
  /// Returns the outcome that is assumed for a point when planning ahead for idle workers: the
  /// prediction of the model or, while lost variables are looked for, the residuals of the best
  /// point, which contain no information.
  ResidualSample expected(const DesignPoint& point) const;
  /// Sets the number of points proposed at a time from now on.
  void widen(int count) { run_.widen(count); }

 private:
  void look_further();
  void take_look(const DesignPoint& point, const std::optional<ResidualSample>& sample);
  void start_trial(const DesignPoint& point, const ResidualSample& sample, double factor);
  void choose();

  TrustRegionRun run_;
  std::optional<LostVariables> lost_;  // set while lost variables are looked for
  Eigen::VectorXd r_settled_;          // residuals at the point where the run settled
  PendingPoints<Wanted> look_;         // the next point of `lost_`; at most one
  /// Runs that start at points where lost variables have an effect.
  std::vector<TrustRegionRun> trials_;
  int allotted_ = 0;  // number of evaluations left to the last trial
};

}  // namespace latsch
