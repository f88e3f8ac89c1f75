// SPDX-License-Identifier: Apache-2.0
// Plots of identifiability: standard deviations along the principal directions, correlations,
// profiles.
#pragma once

#include <string>

#include "report/identifiability.h"

namespace latsch::report {

/// Plots the standard deviation along every principal direction, in percent of the range, on a
/// logarithmic scale. A deviation of 100 % means that the data do not determine the direction.
std::string spectrum_plot(const IdentifiabilityPage& what);

/// Draws a square for every pair of variables: warm if their estimates rise together, cold if one
/// falls as the other rises.
std::string correlation_plot(const IdentifiabilityPage& what);

/// Plots the rise of the sum of squares over one variable, with the threshold and the interval in
/// which the rise is below it.
std::string profile_plot(const ProfileCurve& curve);

}  // namespace latsch::report
