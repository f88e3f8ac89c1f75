// SPDX-License-Identifier: Apache-2.0
// Reports what a .tir lacks: coefficients without which a tire has no force, or slips do not act on
// each other.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "models/magic_formula/parameters.h"

namespace latsch::formats {

/// Calls `note` with a sentence for each quantity whose coefficients are missing, and for missing
/// coefficients of combined slip. `is_given` returns whether the file states a parameter, or a note
/// on it has been made.
void report_missing(const magic_formula::Parameters& parameters,
                    const std::function<bool(std::string_view)>& is_given,
                    const std::function<void(const std::string&)>& note);

}  // namespace latsch::formats
