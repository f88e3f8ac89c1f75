// SPDX-License-Identifier: Apache-2.0
// Coefficients of a .tir that only the rigid ring uses, and what is assumed without them.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "models/magic_formula/parameters.h"

namespace latsch::rigid_ring {

/// Fails if the cams and the patch of these coefficients feel no road: an ELLIPS_SHIFT,
/// ELLIPS_LENGTH, ELLIPS_HEIGHT or ELLIPS_ORDER that no cam has, a patch longer than the tire.
Status check_cams(const magic_formula::Parameters& parameters);

/// Returns one sentence for each number that is assumed, changed, or contradicts another.
/// `is_given` says whether the file states a coefficient.
std::vector<std::string> ring_doubts(const magic_formula::Parameters& parameters,
                                     const std::function<bool(std::string_view)>& is_given);

}  // namespace latsch::rigid_ring
