// SPDX-License-Identifier: Apache-2.0
// How a run goes on, when it stops and what it tells meanwhile.
#pragma once

#include <functional>
#include <optional>

#include "optimization/problem/design_point.h"
#include "optimization/problem/design_space.h"

namespace latsch {

/// What follows from a failed trial. A design of experiments, which nobody has to answer to, knows
/// only the first two.
struct FailurePolicy {
  enum class Then {
    proceed,       // an optimizer takes the point as worse than any that succeeded
    abort,         // the run ends
    recover,       // it is told `penalty`; see failure_answer.h
    continuation,  // it is told the value of the last point, going there, that succeeds
  };
  Then then = Then::proceed;
  /// How often a failed trial is tried again before it counts as failed. No point is started more
  /// than `retries` + 2 times, copies of stragglers and what replaces lost workers included.
  int retries = 0;
  double penalty = 1.0;                   // of the target function
  int halvings = 4;                       // trials of a continuation
  std::optional<DesignSpace> space = {};  // which a continuation needs
};

/// What a progress bar needs.
struct RunProgress {
  long known = 0;        // of the points wanted so far, those whose outcome is known
  long planned = 0;      // how many it can become: the plan's size or the largest number of steps
  long evaluated = 0;    // trials that ran in this process
  long failed = 0;       // of these
  long repeated = 0;     // trials started again: their worker was lost, or they failed
  long copied = 0;       // stragglers started a second time
  long stopped = 0;      // stragglers that were withdrawn
  int running = 0;       // points
  int straggling = 0;    // of these, run much longer than usual
  double slowest = 0.0;  // s, how long the one that runs longest has
  double elapsed = 0.0;  // s since the run began
  double trial_wall_time = 0.0;  // s, mean over `evaluated`
  std::optional<double> best;    // target of the best point so far
  DesignPoint best_point;
};

struct RunOptions {
  long max_steps = 1000;  // outcomes the optimizer may observe
  int look_ahead = 4;     // points proposed ahead for every worker, where there are several
  FailurePolicy on_failure = {};
  /// A trial that runs so many times longer than the median is a straggler and started a second
  /// time where a worker has nothing else to do; 0: none is.
  double straggler_factor = 3.0;
  /// A straggler is stopped where nobody names its point any more and a wanted one waits for a
  /// worker.
  bool stop_unwanted = true;
  /// False for a simulated world, where a commit must not take real time.
  bool commit_in_background = true;
  /// Called after every outcome and about ten times a second.
  std::function<void(const RunProgress&)> on_progress = {};
  /// Asked about ten times a second; running trials then get `stop_patience` seconds to end.
  std::function<bool()> stop_requested = {};
  double stop_patience = 1.0;
};

}  // namespace latsch
