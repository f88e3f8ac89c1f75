// SPDX-License-Identifier: Apache-2.0
// One number of a channel: its largest, smallest, mean, first or last value.
#pragma once

#include <string>
#include <vector>

#include "measurement/channels.h"

namespace latsch::correlation {

/// "largest", "smallest", "mean", "first", "last"
const std::vector<std::string>& names_of_values();

/// By one of those names; the channel has values.
double value_of(const std::string& of, const std::vector<double>& values);
/// Its slopes, one a variable, of a channel that knows them; the largest and the smallest value
/// stay where they are.
std::vector<double> slopes_of(const std::string& of, const Channel& channel);

}  // namespace latsch::correlation
