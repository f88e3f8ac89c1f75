// SPDX-License-Identifier: Apache-2.0
// What each view of the page shows, as JSON: docs/studio.md has the shape of every answer. Numbers
// are in the unit named beside them, targets are ratios, null is not known or not finite.
//
// Each throws InputError for a request that asks for what is not there.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "studio/shelf/shelf.h"
#include "studio/shelf/study_runs.h"

namespace latsch::studio {

using Json = nlohmann::ordered_json;

/// The studies of the folder, their states and best targets.
Json home_view(const Shelf& shelf, const std::string& version, bool has_page);

/// Variables, experiments, state, best point, failures by reason.
Json study_view(const ShelvedStudy& study, StudyRuns& runs);

/// Target over trials, at most `most` of them: of every stretch the least and the greatest. Trials
/// are numbered from 1; `to` 0: the last.
struct Stretch {
  long from = 1, to = 0, most = 4000;
};
Json convergence_view(const ShelvedStudy& study,
                      const Stretch& stretch,
                      const std::string& weights);

/// Rows of the table of trials.
struct TrialsPage {
  long from = 1, count = 50;  // of the order
  bool by_target = false;
};
Json trials_view(const ShelvedStudy& study, const TrialsPage& page, const std::string& weights);
/// One of them, with what its experiments add to the target.
Json trial_view(const ShelvedStudy& study, long trial);

/// Measured and simulated values of every experiment at a trial ("12") or the best one ("best").
Json comparison_view(const ShelvedStudy& study, const std::string& trial);

/// Surfaces, slices and minima of the target function, as far as trials show them.
Json target_view(const ShelvedStudy& study, const std::string& weights);

/// Single numbers: weight, target, initial, optimized, and why one is to be doubted.
Json kpi_view(const ShelvedStudy& study, const std::string& weights);

/// What the measurements determine, as far as the journal tells.
Json identifiability_view(const ShelvedStudy& study);

/// The numbers of the model.
Json model_view(const ShelvedStudy& study);
/// The model at a trial in space, as the buffer that docs/studio.md describes.
std::string scene_view(const ShelvedStudy& study, const std::string& trial);
/// Its section; null where it has none.
Json section_view(const ShelvedStudy& study, const std::string& trial);

/// Two studies beside each other.
Json comparing_view(const ShelvedStudy& a, const ShelvedStudy& b);

}  // namespace latsch::studio
