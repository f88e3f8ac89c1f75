// SPDX-License-Identifier: Apache-2.0
// Prints how well the data determine the variables: values with intervals, spectrum of the
// Jacobian, correlations, verdicts.
#pragma once

#include <string>
#include <vector>

#include "correlation/analysis/identifiability.h"
#include "correlation/analysis/measurement_gains.h"
#include "correlation/analysis/missed_values.h"
#include "correlation/analysis/prediction_bands.h"

namespace latsch::cli {

/// Prints the point like print_point, each value with its confidence interval.
void print_intervals(const correlation::Study& study, const correlation::Identifiability& result);

/// Prints the spectrum of the Jacobian, correlations, verdicts, cross-validation, and the
/// measurements that should be repeated.
void print_identifiability(const correlation::Study& study,
                           const correlation::Identifiability& result);

/// Prints the uncertainty of the computed values of every experiment.
void print_bands(const correlation::Study& study,
                 const std::vector<correlation::ExperimentBand>& bands);

/// Prints the nuisance numbers of all recordings and what they cost the intervals of the variables.
void print_nuisance(const correlation::Study& study,
                    const std::vector<correlation::ExperimentBand>& bands);

/// Prints the fitted time delays of recordings, one in each line; nothing if none is fitted.
void print_delays(const correlation::Study& study,
                  const std::vector<correlation::ExperimentBand>& bands);

/// Prints the measurements that would give the most information about the variables.
void print_gains(const correlation::Study& study,
                 const std::string& title,
                 const std::vector<correlation::MeasurementGain>& gains);

/// Prints the measured values that the model misses, and the variable that would correct each.
void print_missed(const correlation::Study& study,
                  const std::vector<correlation::MissedValue>& missed);

}  // namespace latsch::cli
