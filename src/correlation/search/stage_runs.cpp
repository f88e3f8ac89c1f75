// SPDX-License-Identifier: Apache-2.0
#include "correlation/search/stage_runs.h"

#include <filesystem>
#include <utility>

#include "correlation/search/study_method.h"
#include "correlation/study/study_stages.h"
#include "correlation/target/best_trial.h"
#include "correlation/target/estimated_noise.h"
#include "optimization/strategy/hopeless_start.h"

namespace latsch::correlation {
namespace {

/// The end of a stage, from which the next stage starts.
struct StageEnd {
  DesignPoint point;          // best point
  Channels recording;         // at that point
  std::vector<OwnStage> own;  // one for each experiment, from this stage and the earlier ones
};

StageEnd end_of_stage(const Study& study,
                      int k,
                      const DesignPoint& best,
                      const Journal& journal,
                      const std::optional<StageEnd>& before) {
  StageEnd end{best, recording_at(best, journal), {}};
  if (before) end.own = before->own;
  add_stage_end(study, k, end.recording, end.own);
  return end;
}

std::vector<double> rms_of(const std::vector<OwnStage>& own) {
  std::vector<double> all;
  for (const OwnStage& one : own) all.push_back(one.rms);
  return all;
}

/// Returns stage k of a study with the noise that follows from the end of the stage before. The
/// first stage has none before it, so its noise is not known.
Study weighted_stage(const Study& study, int k, const std::optional<StageEnd>& before) {
  Study part = stage(study, k, before ? std::optional(before->point) : std::nullopt);
  if (!estimates_noise(study)) return part;
  if (before)
    estimate_noise(part, &before->recording, rms_of(before->own));
  else
    estimate_noise(part, nullptr);
  return part;
}

/// True if the last stage has other experiments, variables or noise than the study as written.
bool differs_in_last_stage(const Study& study) {
  if (estimates_noise(study)) return true;
  return !study.stages.empty() &&
         (!study.stages.back().experiments.empty() || !study.stages.back().free.empty());
}

}  // namespace

StagesRun run_stages(const Study& study, const RunStage& run_stage) {
  StagesRun stages{study};
  std::optional<StageEnd> before;
  const std::vector<Study> written = stages_of(study);
  for (std::size_t k = 0; k < written.size(); ++k) {
    const int number = static_cast<int>(k);
    StageRun part{.number = number,
                  .is_last = k + 1 == written.size(),
                  .study = weighted_stage(study, number, before)};
    part.next_shares_journal =
        !part.is_last && written[k + 1].run.journal == part.study.run.journal;
    if (part.is_last)
      take_stage(part.study, stages.study);
    else
      take_noise(part.study, stages.study);
    std::optional<StageResult> result = run_stage(part);
    if (!result) return stages;
    Fit& fit = result->fit;
    if (before) fit.own = before->own;
    stages.end = fit.run.end;
    const bool is_done = stages.end != RunEnd::stopped && stages.end != RunEnd::aborted;
    const Step* best = is_done && !part.is_last ? fit.run.best() : nullptr;
    const bool goes_on = best != nullptr;
    if (best) before = end_of_stage(study, number, best->point, *result->journal, before);
    if (fit.run.steps.empty()) return stages;
    stages.fits.push_back(std::move(fit));
    stages.has_ended = part.is_last && stages.end != RunEnd::stopped;
    if (!goes_on) return stages;
  }
  return stages;
}

StagesRun recorded_stages(const Study& study, const Journal& journal) {
  std::optional<Journal> own;
  return run_stages(study, [&](const StageRun& part) -> std::optional<StageResult> {
    const auto& file = part.study.run.journal;
    const bool has_own = file != study.run.journal;
    if (has_own && !std::filesystem::exists(file)) return std::nullopt;
    if (has_own) own.emplace(Journal::read(file, identity(part.study)));
    const Journal& read = has_own ? *own : journal;
    auto fit = recorded_fit(part.study, read);
    if (!fit) return std::nullopt;
    return StageResult{std::move(*fit), &read};
  });
}

Study with_estimated_noise(const Study& study, const Journal& journal) {
  return differs_in_last_stage(study) ? recorded_stages(study, journal).study : study;
}

Study begun_stage(const Study& study) {
  std::vector<Study> stages = stages_of(study);
  while (stages.size() > 1 && !std::filesystem::exists(stages.back().run.journal))
    stages.pop_back();
  return std::move(stages.back());
}

std::optional<DesignPoint> first_point(const Study& study) {
  const Study first = weighted_stage(study, 0, std::nullopt);
  if (first.start.from != StartSettings::From::values) return std::nullopt;
  const auto wanted = HopelessStart(first.space, make_optimizer(first)).propose(1);
  return wanted.empty() ? std::nullopt : std::optional(wanted.front());
}

std::vector<std::string> spoiled_experiments(const StagesRun& stages, const Journal& journal) {
  if (!stages.has_ended || stages.fits.empty() || stages.fits.back().own.empty()) return {};
  const auto best = best_trial(stages.study, journal);
  if (!best) return {};
  return spoiled_experiments(
      stages.study, stages.fits.back().own, recording_at(best->point, journal));
}

}  // namespace latsch::correlation
