// SPDX-License-Identifier: Apache-2.0
// The content of each view of the page, as JSON: docs/studio.md describes the shape of every
// answer. Numbers are in the unit named beside them, targets are ratios, null means not known or
// not finite.
//
// Each function throws InputError for a request for something that does not exist.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "formats/text/json.h"
#include "studio/shelf/shelf.h"
#include "studio/shelf/study_runs.h"

namespace latsch::experiment {
struct Language;
}

namespace latsch::studio {

/// Returns the studies of the folder, their states and best targets.
Json home_view(const Shelf& shelf, const std::string& version, bool has_page);

/// Returns sentence and choices of the keys of every table that occurs once in a study, as their
/// readers declare them: {"run": {"on_failure": {"sentence": "...", "choices": [...]}}}.
Json keys_view(const experiment::Language& language);

/// Returns variables, experiments, state, best point, failures by reason.
Json study_view(const ShelvedStudy& study, StudyRuns& runs);

/// Least value of `most`: with fewer points a stretch cannot show its least and its greatest.
inline constexpr long kFewestPoints = 10;

/// Target over trials, at most `most` of them: the least and the greatest of every stretch. Trials
/// are numbered from 1; `to` = 0 means the last.
struct TrialRange {
  long from = 1, to = 0, most = 4000;
};
Json convergence_view(const ShelvedStudy& study,
                      const TrialRange& stretch,
                      const std::string& weights);

/// Rows of the table of trials.
struct TrialsPage {
  long from = 1, count = 50;  // indices in the order of the table
  bool by_target = false;
};
Json trials_view(const ShelvedStudy& study, const TrialsPage& page, const std::string& weights);
/// Returns one trial, with the contribution of each experiment to the target.
Json trial_view(const ShelvedStudy& study, long trial);

/// Returns measured and simulated values of every experiment at a trial ("12") or the best one
/// ("best").
Json comparison_view(const ShelvedStudy& study, const std::string& trial);

/// Returns the limits that the model meets in the tests at a trial, as comparison_view() names it:
/// ranges of a tire's file that are left, a tire off the road. Takes a trial's time.
Json limits_view(const ShelvedStudy& study, const std::string& trial);

/// Returns surfaces, slices and minima of the target function, as far as trials show them.
Json target_view(const ShelvedStudy& study, const std::string& weights);

/// Returns single numbers: weight, target, initial and optimized value, and reasons for doubt.
Json kpi_view(const ShelvedStudy& study, const std::string& weights);

/// Returns intervals, directions and profiles, as far as the journal contains them.
Json identifiability_view(const ShelvedStudy& study);

/// Returns the numbers of the model.
Json model_view(const ShelvedStudy& study);
/// Returns the model in space at a trial, as the buffer that docs/studio.md describes.
std::string scene_view(const ShelvedStudy& study, const std::string& trial);
/// Returns the model's section; null if it has none.
Json section_view(const ShelvedStudy& study, const std::string& trial);

/// Returns two studies beside each other.
Json comparing_view(const ShelvedStudy& a, const ShelvedStudy& b);

}  // namespace latsch::studio
