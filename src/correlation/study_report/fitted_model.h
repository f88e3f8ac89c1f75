// SPDX-License-Identifier: Apache-2.0
// The model that a study has found, with the origin of its numbers, for a file that other people
// read: data, target, errors of each experiment, and the interval of each fitted value.
//
// Errors of fitted experiments come from the journal. Held-out experiments are simulated once at
// the point found. Intervals are those that the journal knows; nothing is computed for them.
#pragma once

#include <optional>
#include <string>

#include "base/document.h"
#include "correlation/study/study.h"
#include "evaluation/journal/journal.h"
#include "experiment/language/provenance.h"

namespace latsch::correlation {

/// Date and program version for a file that is written; the study does not contain them.
struct ExportedBy {
  std::string version;  // "0.1.0"
  std::string date;     // "2026-03-01"
};

struct FittedModel {
  Document numbers;
  experiment::Provenance provenance;
  /// False: no trial has succeeded yet, so the numbers are the initial values.
  bool is_fitted = false;
  bool search_has_ended = true;  // false: the numbers are those of the best trial so far
};

/// Returns the model of the best trial in the journal of the study, or of the initial values if
/// there is no journal. `at` is another point of the study, which need not be in the journal.
/// Throws InputError if the journal belongs to another study or to an earlier version of this one,
/// even if only a measurement, a weight or a bound has changed (search/search_standing.h).
FittedModel fitted_model(const Study& study,
                         const ExportedBy& by,
                         const std::optional<DesignPoint>& at = std::nullopt);

/// Returns the text of the model's file with the origins in comments. Requires a study with a kind
/// of model, not an outside program.
std::string text_of(const Study& study, const FittedModel& model);

}  // namespace latsch::correlation
