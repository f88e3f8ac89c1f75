// SPDX-License-Identifier: Apache-2.0
// What the data determine, as text: intervals beside values, spectrum, correlations, verdicts.
#pragma once

#include "correlation/identifiability.h"

namespace latsch::cli {

/// The point as print_point does, each value with its confidence interval.
void print_intervals(const correlation::Study& study, const correlation::Identifiability& result);

/// Spectrum, correlations, verdicts and cross-validation.
void print_identifiability(const correlation::Study& study,
                           const correlation::Identifiability& result);

}  // namespace latsch::cli
