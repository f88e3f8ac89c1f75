// SPDX-License-Identifier: Apache-2.0
// Converts numbers to JSON values for the page.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace latsch::studio {

/// Returns the value as JSON; null if it is not finite.
nlohmann::ordered_json finite(double value);
nlohmann::ordered_json finite(const std::optional<double>& value);
nlohmann::ordered_json finite(const std::vector<double>& values);

/// Converts values from SI to `unit` and rounds them to seven significant digits, which is
/// sufficient for a page.
nlohmann::ordered_json in_unit(double si, const std::string& unit);
nlohmann::ordered_json in_unit(const std::vector<double>& si, const std::string& unit);

}  // namespace latsch::studio
