// SPDX-License-Identifier: Apache-2.0
#include "correlation/search/study_fit.h"

#include "correlation/search/study_search.h"
#include "correlation/target/study_trials.h"
#include "correlation/target/trial_ownership.h"
#include "evaluation/schedule/retried_failures.h"
#include "optimization/strategy/hopeless_start.h"

namespace latsch::correlation {

Fit fit(const Study& stage, Executor& executor, Journal& journal, const RunOptions& options) {
  mark_target(stage, journal);
  TrialsThatCount trials(journal);
  if (stage.start.from == StartSettings::From::basins) {
    const auto end = run_doe(plan(*stage.doe, stage.space), executor, trials, options);
    if (end == RunEnd::stopped) return {};
  }
  HopelessStart search(stage.space, begin_search(stage, journal));
  Run run = run_optimizer(search, objective(stage), executor, &trials, options);
  if (run.end == RunEnd::converged || run.end == RunEnd::max_steps) mark_ended(stage, journal);
  return {std::move(run), search.reason()};
}

std::optional<Fit> recorded_fit(const Study& stage, const Journal& journal) {
  auto optimizer = begun_search(stage, journal);
  if (!optimizer) return std::nullopt;
  HopelessStart search(stage.space, std::move(optimizer));
  Run run = replay(
      search, objective(stage), TrialsThatCount(journal), stage.max_steps, stage.run.on_failure);
  return Fit{std::move(run), search.reason()};
}

Channels recording_at(const DesignPoint& point, const Journal& journal) {
  Channels recording;
  journal.for_each([&](const Trial& trial) {
    if (trial.point == point && trial.outcome.result) recording = *trial.outcome.result;
  });
  return recording;
}

}  // namespace latsch::correlation
