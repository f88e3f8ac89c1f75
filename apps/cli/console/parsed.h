// SPDX-License-Identifier: Apache-2.0
// What a person writes on the command line, with the words for what is wrong.
#pragma once

#include <string>

#include "base/document.h"
#include "optimization/problem/design_space.h"

namespace latsch::cli {

/// "25 mm" in the SI unit `unit`; `option` names the culprit in the InputError.
double parse_option(const std::string& option,
                    const std::string& text,
                    const std::string& unit,
                    Range range = Range::positive());

/// "matrix=12 N/mm^2" applied to the point. Throws InputError for a name the space does not have, a
/// wrong dimension or a value outside the bounds.
void set_variable(const DesignSpace& space, const std::string& assignment, DesignPoint& point);

}  // namespace latsch::cli
