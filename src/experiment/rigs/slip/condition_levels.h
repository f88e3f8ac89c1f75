// SPDX-License-Identifier: Apache-2.0
// Finds the levels of load, camber, pressure and speed among states of a rolling tire
// (numerics/signals/distinct_levels.h); they decide which coefficients of the Magic Formula are
// identifiable.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "models/magic_formula/coefficient_conditions.h"

namespace latsch {

/// `values_of` returns the values of a channel (Fz, gamma, p, Vx) in SI, or none if it does not
/// exist.
magic_formula::ConditionLevels condition_levels(
    const std::function<std::vector<double>(const std::string&)>& values_of);

/// Returns for each coefficient the reason why these values cannot determine it:
/// magic_formula::reason_against().
std::vector<std::string> reasons_against(
    const std::vector<std::string>& coefficients,
    const std::function<std::vector<double>(const std::string&)>& values_of);

}  // namespace latsch
