// SPDX-License-Identifier: Apache-2.0
// Runs the stages of a study (study_stages.h) in turn, by evaluating trials or by reading them from
// the journals. Every stage starts at the best point of the stage before, with the noise that the
// earlier stages left. A study without stages is run as one stage.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "correlation/search/study_fit.h"
#include "correlation/study/study.h"
#include "evaluation/journal/journal.h"

namespace latsch::correlation {

/// One stage as it is run.
struct StageRun {
  int number = 0;                    // counted from 0
  bool is_last = true;               // false: another stage follows
  bool next_shares_journal = false;  // true if the next stage adds its trials to the same journal
  /// the study as it is during the stage, with its model, start, variables, experiments, noise,
  /// optimizer and journal
  Study study;
};

/// Result of a stage, with the journal that holds its trials. The journal must exist until
/// run_stages() has returned.
struct StageResult {
  Fit fit;                           // steps and end of the search
  const Journal* journal = nullptr;  // holds the stage's trials
};

/// Runs one stage; nullopt if that is not possible yet.
using RunStage = std::function<std::optional<StageResult>(const StageRun&)>;

/// The stages of a study that have been run.
struct StagesRun {
  /// The study in the state of its last stage, as far as that is known: the noise, the fitted
  /// experiments and the free variables.
  Study study;
  std::vector<Fit> fits = {};    // one for each stage that made a step
  RunEnd end = RunEnd::stopped;  // end of the stage that was run last
  /// true if the stage that was run last is the last of the study and was not stopped
  bool has_ended = false;
};

/// Runs the stages in turn. Ends with the first stage that is not possible, is stopped or aborted,
/// or finds no point.
StagesRun run_stages(const Study& study, const RunStage& run_stage);

/// Returns the stages as far as their journals contain them, without evaluating. `journal` is that
/// of the study; a stage with another model has a journal of its own, which is read.
StagesRun recorded_stages(const Study& study, const Journal& journal);

/// Returns the study in the state of its last stage, as far as the journals contain it; see
/// StagesRun. The study is unchanged if the last stage changes nothing. Everything that displays
/// trials uses this study.
Study with_estimated_noise(const Study& study, const Journal& journal);

/// Returns the last stage that has begun a journal of its own, or else the first stage.
Study begun_stage(const Study& study);

/// Returns the first point that the search of a study evaluates; nullopt if it depends on a
/// journal. If a journal lacks a trial there, it contains no step of the search; this check needs
/// no channels.
std::optional<DesignPoint> first_point(const Study& study);

/// For stages that have ended, returns in words the experiments whose error at the study's best
/// trial is worse than after an earlier stage.
std::vector<std::string> spoiled_experiments(const StagesRun& stages, const Journal& journal);

}  // namespace latsch::correlation
