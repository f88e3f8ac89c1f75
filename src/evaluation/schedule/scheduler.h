// SPDX-License-Identifier: Apache-2.0
// Keeps the workers busy with what an optimizer or a sampling plan wants, and the journal complete.
//
// Determinism: an optimizer observes the outcome of the first point it proposed and proposes again,
// whoever finished first; what runs behind that point is speculation that may come true. So neither
// the number of workers nor their timing nor `look_ahead` reaches the trajectory. Points already in
// the journal are not evaluated again: resuming is running the same optimizer once more.
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

/// The trajectory of an optimizer: the same bits for any number of workers, with or without an
/// interruption.
struct Run {
  RunEnd end = RunEnd::stopped;
  /// Why, in words that go on after "the search ended "; empty where it was stopped on request.
  std::string ending = {};
  std::vector<Step> steps = {};

  /// The step with the best score; nullptr where all failed.
  const Step* best() const;
};

/// Runs the optimizer until it converges. With a journal, outcomes in it are reused and new ones
/// appended to it. A run that is aborted ends with the step that failed.
Run run_optimizer(Optimizer& optimizer,
                  const Objective& objective,
                  Executor& executor,
                  TrialStore* journal,
                  const RunOptions& options = {});

/// The trajectory as far as the journal knows it, without evaluating anything: what a report draws.
Run replay(Optimizer& optimizer,
           const Objective& objective,
           const TrialStore& journal,
           long max_steps = 1000,
           const FailurePolicy& on_failure = {});

/// Evaluates the points of the plan that the journal does not know. The outcomes are in the
/// journal.
RunEnd run_doe(const SamplingPlan& plan,
               Executor& executor,
               TrialStore& journal,
               const RunOptions& options = {});

}  // namespace latsch
