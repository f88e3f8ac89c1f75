// SPDX-License-Identifier: Apache-2.0
// The content of each view of the page, as JSON: docs/studio.md describes the form of every answer.
// Numbers have the unit stated beside them, targets are ratios, null means not known or not finite.
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

/// Returns the list of the folder's studies, with their states and best targets.
Json home_view(const Shelf& shelf, const std::string& version, bool has_page);

/// Returns description and choices of the keys of every table that occurs once in a study, as their
/// readers declare them: {"run": {"on_failure": {"sentence": "...", "choices": [...]}}}.
Json keys_view(const experiment::Language& language);

/// Returns a study's variables, experiments, state, best point, and failures by reason.
Json study_view(const ShelvedStudy& study, StudyRuns& runs);

/// Smallest allowed value of TrialRange::most. With fewer points, the smallest and the largest
/// target of a range of trials could not be shown.
inline constexpr long kFewestPoints = 10;

/// A range of trials whose targets are requested; at most `most` points are returned, the least and
/// the greatest of every stretch. Trials are numbered from 1; `to` = 0 means the last.
struct TrialRange {
  long from = 1, to = 0, most = 4000;
};
Json convergence_view(const ShelvedStudy& study,
                      const TrialRange& stretch,
                      const std::string& weights);

/// A part of the table of trials.
struct TrialsPage {
  long from = 1, count = 50;  // positions in the order of the table
  bool by_target = false;
};
Json trials_view(const ShelvedStudy& study, const TrialsPage& page, const std::string& weights);
/// Returns one trial, with the contribution of each experiment to its target.
Json trial_view(const ShelvedStudy& study, long trial);

/// Returns measured and simulated values of every experiment at a trial, which is a number ("12")
/// or the best one ("best").
Json comparison_view(const ShelvedStudy& study, const std::string& trial);

/// Returns the limits that the model meets in the tests at a trial ("12" or "best"): validity
/// ranges of a tire's file that it leaves, a tire off the road. Takes the time of a trial.
Json limits_view(const ShelvedStudy& study, const std::string& trial);

/// Returns surfaces, slices and minima of the target function, as far as trials exist for them.
Json target_view(const ShelvedStudy& study, const std::string& weights);

/// Returns the single values: weight, measured, initial and optimized value, and reasons for doubt.
Json kpi_view(const ShelvedStudy& study, const std::string& weights);

/// Returns intervals, directions and profiles, as far as the journal contains them.
Json identifiability_view(const ShelvedStudy& study);

/// Returns the parameters of the model.
Json model_view(const ShelvedStudy& study);
/// Returns the body of the model in space at a trial, as the binary buffer that docs/studio.md
/// describes.
std::string scene_view(const ShelvedStudy& study, const std::string& trial);
/// Returns the cross section of the model; null if it has none.
Json section_view(const ShelvedStudy& study, const std::string& trial);

/// Returns a comparison of two studies.
Json comparing_view(const ShelvedStudy& a, const ShelvedStudy& b);

}  // namespace latsch::studio
