// SPDX-License-Identifier: Apache-2.0
// Coefficients that make a tire differ from its mirror image: with all of them 0, opposite slip
// angle, camber and turn slip give the opposite Fy, Mx and Mz.
#pragma once

#include <string_view>
#include <vector>

#include "models/magic_formula/parameters.h"

namespace latsch::magic_formula {

/// Returns the names of these coefficients that are not 0, in the order of the equations.
std::vector<std::string_view> asymmetric_coefficients(const Parameters& parameters);

}  // namespace latsch::magic_formula
