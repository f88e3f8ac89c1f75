// SPDX-License-Identifier: Apache-2.0
#include "evaluation/scheduler.h"

#include "evaluation/dispatcher.h"

namespace latsch {
namespace {

bool ends_run(const RunOptions& options, const Result<Score>& outcome) {
  return !outcome && options.on_failure.then == FailurePolicy::Then::abort;
}

}  // namespace

const Step* Run::best() const {
  const Step* best = nullptr;
  for (const Step& step : steps) {
    if (step.outcome && (!best || step.outcome->value < best->outcome->value)) best = &step;
  }
  return best;
}

Run run_optimizer(Optimizer& optimizer,
                  const Objective& objective,
                  Executor& executor,
                  TrialStore* journal,
                  const RunOptions& options) {
  Dispatcher dispatcher(objective, executor, journal, options, options.max_steps);
  // One worker has no use for speculation.
  const int points = executor.workers() > 1 ? executor.workers() * options.look_ahead : 1;
  Run run;
  run.end = RunEnd::converged;
  while (!optimizer.converged()) {
    if (std::ssize(run.steps) >= options.max_steps) {
      run.end = RunEnd::max_steps;
      break;
    }
    const std::vector<DesignPoint> plan = optimizer.propose(points);
    const Result<Score>* outcome = dispatcher.first_of(plan);
    if (!outcome) {
      run.end = RunEnd::stopped;
      break;
    }
    optimizer.observe(plan.front(), *outcome);
    run.steps.push_back({plan.front(), *outcome});
    dispatcher.count(plan.front(), *outcome, true);
    if (ends_run(options, *outcome)) {
      run.end = RunEnd::aborted;
      break;
    }
  }
  dispatcher.finish();  // speculation that is not needed any more
  dispatcher.report();
  return run;
}

Run replay(Optimizer& optimizer,
           const Objective& objective,
           const TrialStore& journal,
           long max_steps) {
  KnownScores known(objective);
  journal.for_each([&](const Trial& trial) { known.add(trial); });
  Run run;
  while (!optimizer.converged() && std::ssize(run.steps) < max_steps) {
    const DesignPoint point = optimizer.propose(1).front();
    const Result<Score>* outcome = known.find(point);
    if (!outcome) return run;
    optimizer.observe(point, *outcome);
    run.steps.push_back({point, *outcome});
  }
  run.end = optimizer.converged() ? RunEnd::converged : RunEnd::max_steps;
  return run;
}

RunEnd run_doe(const SamplingPlan& plan,
               Executor& executor,
               TrialStore& journal,
               const RunOptions& options) {
  const Objective none;
  Dispatcher dispatcher(none, executor, &journal, options, std::ssize(plan.points));
  RunEnd end = RunEnd::stopped;
  const auto known = [&](const DesignPoint& point, const Result<Score>& outcome) {
    dispatcher.count(point, outcome, false);
    if (ends_run(options, outcome)) end = RunEnd::aborted;
    return end != RunEnd::aborted;
  };
  if (dispatcher.all_of(plan.points, known)) end = RunEnd::converged;
  dispatcher.finish();
  dispatcher.report();
  return end;
}

}  // namespace latsch
