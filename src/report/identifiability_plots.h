// SPDX-License-Identifier: Apache-2.0
// Figures of identifiability: deviations of the directions, correlations, profiles.
#pragma once

#include <string>

#include "report/identifiability.h"

namespace latsch::report {

/// Draws the standard deviation along every direction in percent of the range, on a decade scale. A
/// deviation of 100 % means that the data do not determine the direction.
std::string spectrum_plot(const IdentifiabilityPage& what);

/// Draws a square for every pair of variables: warm if they rise together, cold if one compensates
/// for the other.
std::string correlation_plot(const IdentifiabilityPage& what);

/// Draws the rise of S over one variable, with the threshold and the interval below the threshold.
std::string profile_plot(const ProfileCurve& curve);

}  // namespace latsch::report
