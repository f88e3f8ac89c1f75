// SPDX-License-Identifier: Apache-2.0
// The levels of load, camber, pressure and speed that states of a rolling tire have
// (numerics/signals/distinct_levels.h), for the coefficients of the Magic Formula that they tell.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "models/magic_formula/coefficient_conditions.h"

namespace latsch {

/// `values_of` gives the values of a channel (Fz, gamma, p, Vx) in SI, none where there is none.
magic_formula::ConditionLevels condition_levels(
    const std::function<std::vector<double>(const std::string&)>& values_of);

/// Why these values cannot tell a coefficient, one each: magic_formula::reason_against().
std::vector<std::string> reasons_against(
    const std::vector<std::string>& coefficients,
    const std::function<std::vector<double>(const std::string&)>& values_of);

}  // namespace latsch
