// SPDX-License-Identifier: Apache-2.0
#include "studio/views/json_values.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "base/units.h"

namespace latsch::studio {

using nlohmann::ordered_json;

namespace {

/// Rounds to seven significant digits, so that the text is short.
double short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.7g", value);
  return std::strtod(text, nullptr);
}

}  // namespace

ordered_json finite(double value) {
  return std::isfinite(value) ? ordered_json(short_number(value)) : ordered_json(nullptr);
}

ordered_json finite(const std::optional<double>& value) {
  return value ? finite(*value) : ordered_json(nullptr);
}

ordered_json finite(const std::vector<double>& values) {
  ordered_json list = ordered_json::array();
  for (const double value : values) list.push_back(finite(value));
  return list;
}

ordered_json in_unit(double si, const std::string& unit) {
  const auto known = Unit::find(unit);
  return finite(known ? known->from_si(si) : si);
}

ordered_json in_unit(const std::vector<double>& si, const std::string& unit) {
  const auto known = Unit::find(unit);
  ordered_json list = ordered_json::array();
  for (const double value : si) list.push_back(finite(known ? known->from_si(value) : value));
  return list;
}

}  // namespace latsch::studio
