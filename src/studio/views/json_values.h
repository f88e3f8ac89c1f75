// SPDX-License-Identifier: Apache-2.0
// Formats numbers for the page.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace latsch::studio {

/// Returns null if the value is not finite.
nlohmann::ordered_json finite(double value);
nlohmann::ordered_json finite(const std::optional<double>& value);
nlohmann::ordered_json finite(const std::vector<double>& values);

/// Returns SI values in a unit a person reads, with seven digits, which is enough for a page.
nlohmann::ordered_json in_unit(double si, const std::string& unit);
nlohmann::ordered_json in_unit(const std::vector<double>& si, const std::string& unit);

}  // namespace latsch::studio
