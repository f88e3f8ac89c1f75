// SPDX-License-Identifier: Apache-2.0
// Checks the magnitudes of the numbers in a .tir: values that no tire has are refused or reported,
// because usually a unit in [UNITS] is then wrong.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "models/magic_formula/parameters.h"

namespace latsch::formats {

/// A function that receives a parameter's name and a sentence about it.
using AboutParameter = std::function<void(std::string_view name, const std::string& sentence)>;

/// Calls `refuse`, which throws, for a speed that is not positive and for a negative mass, inertia,
/// damping, stiffness, frequency or length. Calls `note` for a number outside of the range of
/// tires, for masses and inertias that do not fit each other or the tire's size, and for a
/// coefficient whose value 0 removes a force. `is_given` returns whether the file states a
/// parameter.
void examine_sizes(const magic_formula::Parameters& parameters,
                   const std::function<bool(std::string_view)>& is_given,
                   const AboutParameter& refuse,
                   const AboutParameter& note);

}  // namespace latsch::formats
