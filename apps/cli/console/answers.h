// SPDX-License-Identifier: Apache-2.0
// JSON results that several verbs print with `--json`. Names of keys are stable. A physical value
// has its unit beside it or in its key, shares are plain numbers (0.03, not 3 %), and unknown
// values are null.
#pragma once

#include <string>
#include <vector>

#include "cli/console/console.h"
#include "correlation/analysis/identifiability.h"
#include "correlation/analysis/missed_values.h"
#include "correlation/analysis/prediction_bands.h"
#include "correlation/doe/doe_conflict.h"
#include "correlation/study/study.h"
#include "correlation/target/trial_ownership.h"
#include "measurement/channels.h"
#include "optimization/problem/ending_claim.h"
#include "optimization/problem/found_basin.h"

namespace latsch::cli {

/// Returns [{"name", "unit", "values"}], SI.
Json answer_of(const Channels& channels);

/// Writes computed channels as CSV to the file, or to standard output if `file` is empty. With
/// --json and no file, the channels become "channels" of the answer instead.
void give(const Channels& channels, const std::string& file);

/// Returns the values of a design point as [{"name", "value", "unit"}], in the units of the study.
Json answer_of(const DesignSpace& space, const DesignPoint& point);

/// Returns [{"name", "lower", "upper", "initial", "scale", "unit", "paths"}] for the variables.
Json answer_of(const DesignSpace& space);

/// Returns a design point with "interval": [lower, upper] at 95 %, null for an end that nothing
/// limits; "interval_from": the origin of its ends (interval_source()), or "held in the last
/// stage"; and "refined": the value found on the refined model, if the study has one.
Json answer_of(const correlation::Study& study, const correlation::Identifiability& result);

/// Returns the uncertainty bands of the computed values, one for each experiment: values, ends of
/// the band and noise in SI, null if not known; and the number of measured values that lie within
/// band and noise.
Json answer_of(const correlation::Study& study,
               const std::vector<correlation::ExperimentBand>& bands);

/// Returns the statements with which a search ended: [{"statement", "variables", "test",
/// "numbers"}], where "numbers" is [{"name", "value", "unit", "at_most", "at_least"}]. A unit such
/// as "of S" is that of a share, and null stands for a limit that the test does not have.
Json answer_of(const std::vector<EndingClaim>& claims);

/// Returns minima that a search for several ones has found: [{"target", "times_found",
/// "searched_to_its_end", "variables"}], where "variables" is [{"name", "value", "unit"}].
Json answer_of(const DesignSpace& space, const std::vector<FoundBasin>& basins);

/// Returns measured values that no point of a design reaches: {"experiment", "values", "beyond",
/// "between", "farthest", "deviations", "moved_by", "has_to_be", "noise_assumed"}.
Json answer_of(const correlation::Study& study, const correlation::UnreachedValues& row);

/// Returns the fitted delays of recordings: [{"name", "value", "lower", "upper", "at_end",
/// "unit"}], s.
Json delays_of(const correlation::Study& study,
               const std::vector<correlation::ExperimentBand>& bands);

/// Returns the measured values that the model misses as [{"value", "error", "fitted", "variable",
/// "payer", "in_words"}]. "variable" is the variable that would correct the value, null if none
/// affects it. "payer" is another value with the error that it would then have: {"value", "error"}.
Json answer_of(const correlation::Study& study,
               const std::vector<correlation::MissedValue>& missed);

/// Writes the counts of a journal's trials into the answer: "trials", "succeeded", "failed" and
/// "foreign". Foreign trials were run for another study, or for other measurements, weights or
/// bounds. If `targets_known` is false, the trials belong to another study, so it is not known
/// which of them have a target, and "succeeded" and "failed" are null.
void answer_counts(const correlation::TrialCounts& counts, bool targets_known = true);

/// Returns one experiment: measured and simulated values, their errors as shares, mean and largest
/// error.
Json answer_of(const correlation::Study& study,
               const correlation::StudyExperiment& experiment,
               const Channels& trial);

}  // namespace latsch::cli
