// SPDX-License-Identifier: Apache-2.0
#include "models/magic_formula/parameters.h"

#include <cmath>

namespace latsch::magic_formula {

const std::vector<ParameterField>& parameter_fields() {
#define LATSCH_FIELD(section, name, value, unit) \
  {#section, #name, value, ParameterUnit::unit, &Parameters::name},
  static const std::vector<ParameterField> fields = {LATSCH_MAGIC_FORMULA_PARAMETERS(LATSCH_FIELD)};
#undef LATSCH_FIELD
  return fields;
}

std::string_view Parameters::missing_of_turn_slip() const {
  // Limit below which a coefficient counts as 0; those of a fitted tire are above 1e-4.
  constexpr double kLeast = 1e-9;
  const auto is_zero = [](double value) { return std::abs(value) < kLeast; };
  if (is_zero(QDRP1)) return "QDRP1";
  if (is_zero(PHYP1)) return "PHYP1";
  if (is_zero(QCRP1)) return "QCRP1";
  if (is_zero(LKZC)) return "LKZC";
  if (is_zero(QDZ10) && is_zero(QDZ8 * QDZ9)) return "QDZ10";
  return "";
}

const ParameterField* find_parameter(std::string_view name) {
  for (const ParameterField& field : parameter_fields())
    if (field.name == name) return &field;
  return nullptr;
}

}  // namespace latsch::magic_formula
