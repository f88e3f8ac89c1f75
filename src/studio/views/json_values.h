// SPDX-License-Identifier: Apache-2.0
// Numbers as the page gets them.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace latsch::studio {

/// null where it is not finite.
nlohmann::ordered_json finite(double value);
nlohmann::ordered_json finite(const std::optional<double>& value);
nlohmann::ordered_json finite(const std::vector<double>& values);

/// SI values in a unit a person reads, seven digits: a page needs no more.
nlohmann::ordered_json in_unit(double si, const std::string& unit);
nlohmann::ordered_json in_unit(const std::vector<double>& si, const std::string& unit);

}  // namespace latsch::studio
