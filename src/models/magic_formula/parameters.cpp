// SPDX-License-Identifier: Apache-2.0
#include "models/magic_formula/parameters.h"

namespace latsch::magic_formula {

const std::vector<ParameterField>& parameter_fields() {
#define LATSCH_FIELD(section, name, value, unit) \
  {#section, #name, value, ParameterUnit::unit, &Parameters::name},
  static const std::vector<ParameterField> fields = {LATSCH_MAGIC_FORMULA_PARAMETERS(LATSCH_FIELD)};
#undef LATSCH_FIELD
  return fields;
}

const ParameterField* find_parameter(std::string_view name) {
  for (const ParameterField& field : parameter_fields())
    if (field.name == name) return &field;
  return nullptr;
}

}  // namespace latsch::magic_formula
