// SPDX-License-Identifier: Apache-2.0
// What the data determine, as text: intervals beside values, spectrum, correlations, verdicts.
#pragma once

#include <string>
#include <vector>

#include "correlation/analysis/identifiability.h"
#include "correlation/analysis/measurement_gains.h"
#include "correlation/analysis/missed_values.h"
#include "correlation/analysis/prediction_bands.h"

namespace latsch::cli {

/// The point as print_point does, each value with its confidence interval.
void print_intervals(const correlation::Study& study, const correlation::Identifiability& result);

/// Spectrum, correlations, verdicts, cross-validation, and what to measure once more.
void print_identifiability(const correlation::Study& study,
                           const correlation::Identifiability& result);

/// How uncertain the computed values of every experiment are.
void print_bands(const correlation::Study& study,
                 const std::vector<correlation::ExperimentBand>& bands);

/// The fitted delays of recordings, a line each; nothing where none is fitted.
void print_delays(const correlation::Study& study,
                  const std::vector<correlation::ExperimentBand>& bands);

/// Which measurements would tell the most.
void print_gains(const correlation::Study& study,
                 const std::string& title,
                 const std::vector<correlation::MeasurementGain>& gains);

/// Measured values that are missed, and what would mend each.
void print_missed(const correlation::Study& study,
                  const std::vector<correlation::MissedValue>& missed);

}  // namespace latsch::cli
