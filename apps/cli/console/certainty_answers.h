// SPDX-License-Identifier: Apache-2.0
// JSON results on the certainty of a fit: what `latsch identify` prints of correlations,
// directions, profiles, cross-validation and measurements that would add information, and the
// nuisance numbers of recordings. docs/identifiability.md describes the keys.
#pragma once

#include <vector>

#include "cli/console/console.h"
#include "correlation/analysis/identifiability.h"
#include "correlation/analysis/measurement_gains.h"
#include "correlation/analysis/prediction_bands.h"

namespace latsch::cli {

/// Returns {"variables", "matrix"}: the correlations of the variables, null for one without
/// variance.
Json correlations_of(const correlation::Study& study, const correlation::Identifiability& result);

/// Returns the directions of the unit cube from the best determined to the least:
/// [{"singular_value", "deviation", "direction"}], where "direction" has a component for each
/// variable and "deviation" is in shares of the ranges, null without an effect.
Json directions_of(const correlation::Study& study, const correlation::Identifiability& result);

/// Returns the profiles: [{"variable", "unit", "verdict", "in_words", "interval", "points",
/// "other_minima"}], values in the units of the study. The rise of a point is in units of the rise
/// that ends an interval.
Json profiles_of(const correlation::Study& study, const correlation::Identifiability& result);

/// Returns the cross-validation: [{"experiment", "fitted", "predicted"}], root mean squares of the
/// residuals; "predicted" is null if the refit did not converge.
Json left_out_of(const correlation::Study& study, const correlation::Identifiability& result);

/// Returns measurements by the information that each would add, the most useful first:
/// [{"measurement", "shrinkage", "helps", "before", "after"}]. "shrinkage" divides the volume of
/// the confidence region; "before" and "after" are standard deviations of the variable "helps", in
/// shares of its range.
Json gains_of(const correlation::Study& study,
              const std::vector<correlation::MeasurementGain>& gains);

/// Adds "correlations" and "directions" to the answer, and, if they are known, "profiles" and
/// "left_out".
void answer_certainty(const correlation::Study& study, const correlation::Identifiability& result);

/// Adds "nuisance", the numbers of recordings: [{"experiment", "number", "shared", "value",
/// "deviation", "prior", "unit", "from_prior", "at_end", "is_determined", "in_words"}], SI. "prior"
/// and "from_prior" are null for a free number, "deviation" if it is not known, and "is_determined"
/// is false if neither the recording nor a prior determines it beside the variables. Adds
/// "nuisance_costs", the intervals with the numbers solved and with known ones, and
/// "nuisance_remarks", such as numbers that act like a variable.
void answer_nuisance(const correlation::Study& study,
                     const std::vector<correlation::ExperimentBand>& bands);

}  // namespace latsch::cli
