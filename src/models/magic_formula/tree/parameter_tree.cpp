// SPDX-License-Identifier: Apache-2.0
#include "models/magic_formula/tree/parameter_tree.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <vector>

namespace latsch::magic_formula {
namespace {

const char* si_unit_of(ParameterUnit unit) {
  switch (unit) {
    case ParameterUnit::one:
      return "1";
    case ParameterUnit::length:
      return "m";
    case ParameterUnit::force:
      return "N";
    case ParameterUnit::angle:
      return "rad";
    case ParameterUnit::mass:
      return "kg";
    case ParameterUnit::time:
      return "s";
    case ParameterUnit::pressure:
      return "Pa";
    case ParameterUnit::velocity:
      return "m/s";
    case ParameterUnit::acceleration:
      return "m/s^2";
    case ParameterUnit::stiffness:
      return "N/m";
    case ParameterUnit::torsional_stiffness:
      return "N m/rad";
    case ParameterUnit::damping:
      return "N s/m";
    case ParameterUnit::inertia:
      return "kg m^2";
    case ParameterUnit::frequency:
      return "Hz";
  }
  return "1";
}

constexpr const char* kVersions[] = {"5.2", "6.1", "6.2"};
constexpr const char* kSides[] = {"left", "right", "symmetric"};

int index_of(const Node& root, const char* key, std::initializer_list<const char*> names) {
  const std::string chosen = root.choice(key, {names.begin(), names.end()});
  int i = 0;
  for (const char* name : names) {
    if (chosen == name) return i;
    ++i;
  }
  return 0;
}

std::string list(const std::vector<double>& values, const char* unit) {
  return fmt::format("{{unit = \"{}\", values = [{}]}}", unit, fmt::join(values, ", "));
}

}  // namespace

std::string tree_text(const Parameters& p) {
  std::string text = fmt::format("formula = \"{}\"\nside = \"{}\"\nuse_mode = {}\n",
                                 kVersions[static_cast<int>(p.version)],
                                 kSides[static_cast<int>(p.side)],
                                 p.use_mode);
  if (!p.curve_deflection.empty()) {
    text += "curve_deflection = " + list(p.curve_deflection, "m") + "\n";
    text += "curve_force = " + list(p.curve_force, "N") + "\n";
  }
  for (const auto& field : parameter_fields()) {
    const double value = p.*field.member;
    if (!std::isfinite(value)) continue;  // a range without an end is not stored
    const bool plain = field.unit == ParameterUnit::one;
    text += plain ? fmt::format("{} = {}\n", field.name, value)
                  : fmt::format("{} = \"{} {}\"\n", field.name, value, si_unit_of(field.unit));
  }
  return text;
}

Parameters parameters_of(const Document& numbers) {
  const Node root = numbers.root();
  Parameters p;
  p.version = static_cast<Version>(index_of(root, "formula", {"5.2", "6.1", "6.2"}));
  p.side = static_cast<MeasuredSide>(index_of(root, "side", {"left", "right", "symmetric"}));
  p.use_mode = static_cast<int>(root.integer("use_mode", -1'000'000, 1'000'000));
  if (root.has("curve_deflection")) {
    p.curve_deflection = root.quantities("curve_deflection", "m");
    p.curve_force = root.quantities("curve_force", "N");
  }
  for (const auto& field : parameter_fields()) {
    const bool needed = field.name == "UNLOADED_RADIUS" || field.name == "FNOMIN" ||
                        field.name == "VERTICAL_STIFFNESS" || field.name == "NOMPRES" ||
                        field.name == "LONGVL";
    const Range range = needed                  ? Range::positive()
                        : field.name == "VXLOW" ? Range::not_negative()
                                                : Range{};
    if (root.has(field.name)) {
      p.*field.member = root.quantity(field.name, si_unit_of(field.unit), range);
    }
  }
  return p;
}

}  // namespace latsch::magic_formula
