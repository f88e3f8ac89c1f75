// SPDX-License-Identifier: Apache-2.0
// Reads quantities of the command line, with error messages.
#pragma once

#include <string>

#include "base/document.h"
#include "optimization/problem/design_space.h"

namespace latsch::cli {

/// Converts a quantity such as "25 mm" to the SI unit `unit`. Throws InputError that names the
/// option.
double parse_option(const std::string& option,
                    const std::string& text,
                    const std::string& unit,
                    Range range = Range::positive());

/// Returns a share such as "2 %" or 0.02. Throws InputError that names the option if the text is no
/// share, or above 1 without a unit: 2 is more often meant as 2 % than as 200 %.
double parse_share_option(const std::string& option, const std::string& text);

/// Applies "matrix=12 N/mm^2" to the point. Throws InputError for a name that the space does not
/// have, a wrong dimension or a value outside the range.
void set_variable(const DesignSpace& space, const std::string& assignment, DesignPoint& point);

}  // namespace latsch::cli
