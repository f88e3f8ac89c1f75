// SPDX-License-Identifier: Apache-2.0
// Keeps the workers busy with the points that an optimizer or a sampling plan wants, and the
// journal complete.
//
// Determinism: an optimizer observes the outcome of the first point it proposed and proposes again,
// whichever trial finished first; trials of later points are speculation that may prove useful. So
// neither the number of workers nor their timing nor `look_ahead` changes the trajectory. Points
// already in the journal are not evaluated again: resuming is running the same optimizer once more.
#pragma once

#include <string>
#include <vector>

#include "evaluation/executors/executor.h"
#include "evaluation/journal/journal.h"
#include "evaluation/schedule/failure_answer.h"
#include "evaluation/schedule/run_options.h"
#include "optimization/design/sampling_plan.h"
#include "optimization/problem/optimizer.h"

namespace latsch {

enum class RunEnd {
  converged,
  max_steps,
  stopped,  // on request
  aborted   // a trial failed and the failure policy says to end
};

/// Trajectory of an optimizer. Its bits are the same for any number of workers, with or without an
/// interruption.
struct Run {
  RunEnd end = RunEnd::stopped;
  /// Reason in words that continue "the search ended "; empty if it was stopped on request.
  std::string ending = {};
  std::vector<Step> steps = {};

  /// Returns the step with the best score; nullptr if all failed.
  const Step* best() const;
};

/// Runs the optimizer until it converges. With a journal, its outcomes are reused and new ones
/// appended. An aborted run ends with the step that failed.
Run run_optimizer(Optimizer& optimizer,
                  const Objective& objective,
                  Executor& executor,
                  TrialStore* journal,
                  const RunOptions& options = {});

/// Returns the trajectory as far as the journal contains it, without evaluating, for a report.
Run replay(Optimizer& optimizer,
           const Objective& objective,
           const TrialStore& journal,
           long max_steps = 1000,
           const FailurePolicy& on_failure = {});

/// Evaluates the points of the plan that are not in the journal, and stores the outcomes there.
RunEnd run_doe(const SamplingPlan& plan,
               Executor& executor,
               TrialStore& journal,
               const RunOptions& options = {});

}  // namespace latsch
