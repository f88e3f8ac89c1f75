// SPDX-License-Identifier: Apache-2.0
// At which pressure a test has its tire.
//
//   pressure = "2.6 bar"             # or {from = "measurement.cornering"}: the mean of its channel
//                                    # pressure; the tire's own unless given
#pragma once

#include <optional>
#include <string>

#include "base/document.h"
#include "experiment/rigs/measured_conditions.h"

namespace latsch::experiment {

using Inflation = std::optional<double>;  // Pa, gauge; none: the tire's own

/// InputError.
Inflation read_pressure(const Node& test, const MeasuredConditions& measured = {});

/// Behind what else is said of a test: ", 2.6 bar"; "" at the tire's own.
std::string inflated(const Inflation& pressure);

}  // namespace latsch::experiment
