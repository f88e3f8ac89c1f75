// SPDX-License-Identifier: Apache-2.0
// What the data determine, drawn: deviations of the directions, correlations, profiles.
#pragma once

#include <string>

#include "report/identifiability.h"

namespace latsch::report {

/// Standard deviation along every direction in percent of the range, on decades; 100 % is flat.
std::string spectrum_plot(const Identifiability& what);

/// A square for every pair: warm where they rise together, cold where one makes up for the other.
std::string correlation_plot(const Identifiability& what);

/// The rise of S over one variable with the threshold and the interval below it.
std::string profile_plot(const ProfileCurve& curve);

}  // namespace latsch::report
