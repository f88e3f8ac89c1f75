// SPDX-License-Identifier: Apache-2.0
#include "correlation/search/study_fit.h"

#include <filesystem>

#include "correlation/search/study_method.h"
#include "correlation/search/study_search.h"
#include "correlation/study/study_stages.h"
#include "correlation/target/best_trial.h"
#include "correlation/target/estimated_noise.h"
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
  Fit result;
  result.run = run_optimizer(search, objective(stage), executor, &trials, options);
  result.hopeless = search.reason();
  if (result.run.end == RunEnd::converged || result.run.end == RunEnd::max_steps)
    mark_ended(stage, journal);
  return result;
}

Channels recording_at(const DesignPoint& point, const Journal& journal) {
  Channels recording;
  journal.for_each([&](const Trial& trial) {
    if (trial.point == point && trial.outcome.result) recording = *trial.outcome.result;
  });
  return recording;
}

StageEnd end_of_stage(const Study& study,
                      int k,
                      const DesignPoint& best,
                      const Journal& journal,
                      const std::optional<StageEnd>& before) {
  StageEnd end{best, recording_at(best, journal)};
  if (before) end.own = before->own;
  add_stage_end(study, k, end.recording, end.own);
  return end;
}

namespace {

/// True if the last stage has other experiments, variables or noise than the study as written.
bool differs_in_last_stage(const Study& study) {
  if (estimates_noise(study)) return true;
  return !study.stages.empty() &&
         (!study.stages.back().experiments.empty() || !study.stages.back().free.empty());
}

std::vector<double> rms_of(const std::vector<OwnStage>& own) {
  std::vector<double> all;
  for (const OwnStage& one : own) all.push_back(one.rms);
  return all;
}

}  // namespace

Study weighted_stage(const Study& study, int k, const std::optional<StageEnd>& before) {
  Study part = stage(study, k, before ? std::optional(before->point) : std::nullopt);
  if (estimates_noise(study))
    estimate_noise(part,
                   before ? &before->recording : nullptr,
                   before ? rms_of(before->own) : std::vector<double>{});
  return part;
}

Study with_estimated_noise(const Study& study, const Journal& journal) {
  if (!differs_in_last_stage(study)) return study;
  Study weighted = study;
  recorded_fit(study, journal, &weighted);
  return weighted;
}

std::optional<DesignPoint> first_point(const Study& study) {
  const Study first = weighted_stage(study, 0, std::nullopt);
  if (first.start.from != StartSettings::From::values) return std::nullopt;
  const auto wanted = HopelessStart(first.space, make_optimizer(first)).propose(1);
  return wanted.empty() ? std::nullopt : std::optional(wanted.front());
}

std::vector<Fit> recorded_fit(const Study& study, const Journal& journal, Study* weighted) {
  std::vector<Fit> fits;
  std::optional<StageEnd> before;
  for (int k = 0; k < stage_count(study); ++k) {
    const Study part = weighted_stage(study, k, before);
    if (weighted) {
      if (k + 1 == stage_count(study))
        take_stage(part, *weighted);
      else
        take_noise(part, *weighted);
    }
    std::optional<Journal> own;
    if (part.run.journal != study.run.journal) {
      if (!std::filesystem::exists(part.run.journal)) return fits;
      own.emplace(Journal::read(part.run.journal, identity(part)));
    }
    const Journal& read = own ? *own : journal;
    auto optimizer = begun_search(part, read);
    if (!optimizer) return fits;
    HopelessStart search(part.space, std::move(optimizer));
    Fit fit;
    fit.run =
        replay(search, objective(part), TrialsThatCount(read), part.max_steps, part.run.on_failure);
    fit.hopeless = search.reason();
    if (before) fit.own = before->own;
    const bool has_ended = fit.run.end != RunEnd::stopped;
    const Step* found = fit.run.best();
    if (!fit.run.steps.empty()) fits.push_back(fit);
    if (!has_ended || !found) return fits;
    before = end_of_stage(study, k, found->point, read, before);
  }
  return fits;
}

std::vector<std::string> spoiled_experiments(const Study& weighted,
                                             const std::vector<Fit>& fits,
                                             const Journal& journal) {
  if (std::ssize(fits) != stage_count(weighted) || fits.back().own.empty()) return {};
  const auto best = best_trial(weighted, journal);
  if (!best) return {};
  return spoiled_experiments(weighted, fits.back().own, recording_at(best->point, journal));
}

}  // namespace latsch::correlation
