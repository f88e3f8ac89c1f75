// SPDX-License-Identifier: Apache-2.0
// Keeps the workers busy with what an optimizer or a sampling plan wants, and the journal complete.
//
// Determinism: an optimizer observes the outcome of the first point it proposed and proposes again,
// whoever finished first; what runs behind that point is speculation that may come true. So neither
// the number of workers nor their timing nor `look_ahead` reaches the trajectory. Points already in
// the journal are not evaluated again: resuming is running the same optimizer once more.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "evaluation/executor.h"
#include "evaluation/journal.h"
#include "optimization/optimizer.h"
#include "optimization/sampling_plan.h"

namespace latsch {

/// What a progress bar needs.
struct RunProgress {
  long known = 0;      // of the points wanted so far, those whose outcome is known
  long planned = 0;    // how many it can become: the plan's size or the largest number of steps
  long evaluated = 0;  // trials that ran in this process
  long failed = 0;     // of these
  int running = 0;
  double elapsed = 0.0;          // s since the run began
  double trial_wall_time = 0.0;  // s, mean over `evaluated`
  std::optional<double> best;    // least score so far
  DesignPoint best_point;
};

struct RunOptions {
  long max_steps = 1000;  // outcomes the optimizer may observe
  int look_ahead = 4;     // points proposed ahead for every worker, where there are several
  /// Called after every outcome and about ten times a second.
  std::function<void(const RunProgress&)> on_progress = {};
  /// Asked about ten times a second; running trials then get `stop_patience` seconds to end.
  std::function<bool()> stop_requested = {};
  double stop_patience = 1.0;
};

enum class RunEnd { converged, max_steps, stopped };

/// A point the optimizer observed.
struct Step {
  DesignPoint point;
  Result<Score> outcome;
};

/// The trajectory of an optimizer: the same bits for any number of workers, with or without an
/// interruption.
struct Run {
  RunEnd end = RunEnd::stopped;
  std::vector<Step> steps;

  /// The step with the least score; nullptr where all failed.
  const Step* best() const;
};

/// Runs the optimizer until it converges. With a journal, outcomes in it are reused and new ones
/// appended to it.
Run run_optimizer(Optimizer& optimizer,
                  const Objective& objective,
                  Executor& executor,
                  Journal* journal,
                  const RunOptions& options = {});

/// The trajectory as far as the journal knows it, without evaluating anything: what a report draws.
Run replay(Optimizer& optimizer,
           const Objective& objective,
           const Journal& journal,
           long max_steps = 1000);

/// Evaluates the points of the plan that the journal does not know. The outcomes are in the
/// journal.
RunEnd run_doe(const SamplingPlan& plan,
               Executor& executor,
               Journal& journal,
               const RunOptions& options = {});

}  // namespace latsch
