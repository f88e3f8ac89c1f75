// SPDX-License-Identifier: Apache-2.0
// Results of several verbs for other programs, as printed by `--json`. Keys do not change; a value
// has its unit beside it or in its key; shares are plain numbers (0.03, not 3 %); unknown values
// are null.
#pragma once

#include <string>
#include <vector>

#include "cli/console/console.h"
#include "correlation/analysis/identifiability.h"
#include "correlation/analysis/missed_values.h"
#include "correlation/analysis/prediction_bands.h"
#include "correlation/study/study.h"
#include "correlation/target/trial_ownership.h"
#include "measurement/channels.h"

namespace latsch::cli {

/// Returns [{"name", "unit", "values"}], SI.
Json answer_of(const Channels& channels);

/// Writes computed channels as CSV to the file, or without a file to standard output; with --json
/// and without a file they become "channels" of the answer.
void give(const Channels& channels, const std::string& file);

/// Returns [{"name", "value", "unit"}], in the units of the study.
Json answer_of(const DesignSpace& space, const DesignPoint& point);

/// Returns [{"name", "lower", "upper", "initial", "scale", "unit", "paths"}] for the variables.
Json answer_of(const DesignSpace& space);

/// Returns a point with "interval": [lower, upper] at 95 %, null for an end that nothing limits;
/// "interval_from": what sets its ends, see interval_source(), or "held in the last stage"; and
/// "refined": the number of the refined model, if the study has one.
Json answer_of(const correlation::Study& study, const correlation::Identifiability& result);

/// Returns the bands, one for each experiment: values, ends and noise in SI, null if not known; and
/// the number of measured values within band and noise.
Json answer_of(const correlation::Study& study,
               const std::vector<correlation::ExperimentBand>& bands);

/// Returns the fitted delays of recordings: [{"name", "value", "lower", "upper", "at_end",
/// "unit"}], s.
Json delays_of(const correlation::Study& study,
               const std::vector<correlation::ExperimentBand>& bands);

/// Returns [{"value", "error", "fitted", "variable", "payer", "in_words"}]; variable: null if none
/// affects the value; payer: the {"value", "error"} that would result if the variable corrected the
/// other value alone.
Json answer_of(const correlation::Study& study,
               const std::vector<correlation::MissedValue>& missed);

/// Writes the counts of a journal's trials into the answer: "trials", "succeeded", "failed" and
/// "foreign", those that were run for another study, or for other measurements, weights or bounds.
/// `targets_known` false: the trials belong to another study, so which of them have a target is not
/// known, and "succeeded" and "failed" are null.
void answer_counts(const correlation::TrialCounts& counts, bool targets_known = true);

/// Returns one experiment: measured beside simulated values, errors as shares, mean and largest
/// error.
Json answer_of(const correlation::StudyExperiment& experiment, const Channels& trial);

}  // namespace latsch::cli
