// SPDX-License-Identifier: Apache-2.0
// Reduces a channel to one number: its largest, smallest, mean, first or last value.
#pragma once

#include <string>
#include <vector>

#include "measurement/channels.h"

namespace latsch::correlation {

/// Returns the names of the reductions: "largest", "smallest", "mean", "first", "last".
const std::vector<std::string>& names_of_values();

/// Returns the value with one of the given names. The channel must have values.
double value_of(const std::string& of, const std::vector<double>& values);
/// Returns the derivatives of value_of() by each variable, for a channel with known derivatives.
/// The sample with the largest or smallest value is assumed to stay the same.
std::vector<double> slopes_of(const std::string& of, const Channel& channel);

}  // namespace latsch::correlation
