// SPDX-License-Identifier: Apache-2.0
// Options of a run: failures, end and progress reports.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "optimization/problem/design_point.h"
#include "optimization/problem/design_space.h"

namespace latsch {

/// Reaction to a failed trial. A design of experiments, which has no optimizer, supports only
/// `proceed` and `abort`.
struct FailurePolicy {
  enum class Then {
    proceed,  // The optimizer treats the point as worse than any that succeeded.
    abort,    // The run ends.
    recover,  // The optimizer receives `penalty`; see failure_answer.h.
    /// The optimizer receives the value of the last successful point on the path to the failed
    /// point.
    continuation,
  };
  Then then = Then::proceed;
  /// Number of repeats of a failed trial before it counts as failed. No point is started more than
  /// `retries` + 2 times, including copies of stragglers and replacements of lost workers.
  int retries = 0;
  double penalty = 1.0;                   // value of the target function for failed points
  int halvings = 4;                       // number of trials in a continuation
  std::optional<DesignSpace> space = {};  // variables and bounds, which a continuation needs
};

/// The state of a run, for a progress bar.
struct RunProgress {
  long known = 0;  // wanted points so far whose outcome is known
  /// Upper limit of `known`: the size of the sampling plan or the largest number of steps.
  long planned = 0;
  std::string work;      // purpose of the trials; empty: that of the run
  long evaluated = 0;    // number of trials that ran in this process
  long failed = 0;       // failed trials among `evaluated`
  long repeated = 0;     // number of trials started again because of a lost worker or a failure
  long copied = 0;       // number of stragglers started a second time
  long stopped = 0;      // number of stragglers that were withdrawn
  int running = 0;       // running points
  int straggling = 0;    // number of running points that take much longer than usual
  double slowest = 0.0;  // s, time of the longest running trial so far
  double elapsed = 0.0;  // s since the run began
  double trial_wall_time = 0.0;  // mean duration of the trials `evaluated`, s
  std::optional<double> best;    // target of the best point so far
  DesignPoint best_point;
};

struct RunOptions {
  long max_steps = 1000;  // largest number of outcomes that the optimizer observes
  int look_ahead = 4;     // number of points proposed ahead for each of several workers
  FailurePolicy on_failure = {};
  /// A trial that runs more than this many times as long as the median is a straggler; a second
  /// copy of it is started if a worker is idle. If the value is 0, no trial counts as a straggler.
  double straggler_factor = 3.0;
  /// Stops a straggler if its point is no longer requested and a wanted point waits for a worker.
  bool stop_unwanted = true;
  /// False for a simulation with a virtual clock, in which a commit must not take real time.
  bool commit_in_background = true;
  /// Called after every outcome and about ten times a second.
  std::function<void(const RunProgress&)> on_progress = {};
  /// Called about ten times a second. Once it returns true, running trials get `stop_patience`
  /// seconds to end, and the run stops.
  std::function<bool()> stop_requested = {};
  double stop_patience = 1.0;
};

}  // namespace latsch
