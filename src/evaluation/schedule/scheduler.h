// SPDX-License-Identifier: Apache-2.0
// Keeps the workers busy with the points that an optimizer or a sampling plan wants, and writes
// every outcome to the journal.
//
// Determinism: an optimizer observes the outcome of the first point it proposed and proposes again,
// whichever trial finished first; trials of later points are speculation that may prove useful. So
// neither the number of workers nor their timing nor `look_ahead` changes the trajectory. Points
// already in the journal are not evaluated again, so a search is resumed by running the same
// optimizer once more from its start.
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
  aborted   // a trial failed and the failure policy is to abort
};

/// Trajectory of an optimizer. Its bits are the same for any number of workers, with or without an
/// interruption.
struct Run {
  RunEnd end = RunEnd::stopped;
  /// Reason why the search ended, in words that continue "the search ended "; empty if it was
  /// stopped on request.
  std::string ending = {};
  /// The statements of `ending`, each with its test and the numbers of the test.
  std::vector<EndingClaim> claims = {};
  /// The minima that were found, lowest first; empty for methods that look for one alone.
  std::vector<FoundBasin> basins = {};
  std::vector<Step> steps = {};

  /// Returns the step with the best score; nullptr if all failed.
  const Step* best() const;
};

/// Runs the optimizer until it converges. If there is a journal, outcomes in it are reused and new
/// ones are appended. The last step of an aborted run is the one that failed.
Run run_optimizer(Optimizer& optimizer,
                  const Objective& objective,
                  Executor& executor,
                  TrialStore* journal,
                  const RunOptions& options = {});

/// Repeats the optimizer with the outcomes in the journal, without evaluating anything, and returns
/// its trajectory as far as the outcomes reach. For reports.
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
