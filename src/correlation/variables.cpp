// SPDX-License-Identifier: Apache-2.0
#include "correlation/variables.h"

#include <cassert>

#include "base/units.h"

namespace latsch::correlation {
namespace {

std::string unit_of(const Node& table,
                    const std::string& key,
                    const Document& model,
                    const std::string& path) {
  try {
    return model.unit(path);
  } catch (const InputError& error) {
    table.reject(key, std::string("leads to no number of the model: ") + error.what());
  }
}

/// "N/mm^2" of "22.3 N/mm^2".
std::string written_unit(const std::string& text) {
  const auto quantity = parse_quantity(text);
  return quantity ? quantity->unit.text() : "1";
}

}  // namespace

DesignVariable read_variable(const Node& table, const Document& model) {
  DesignVariable variable;
  variable.name = table.name();
  variable.place = table.place();
  const std::string key = table.has("paths") ? "paths" : "path";
  variable.paths = key == "paths" ? table.texts(key) : std::vector{table.text(key)};
  if (variable.paths.empty()) table.reject(key, "is empty, expected at least one path");

  const std::string unit = unit_of(table, key, model, variable.paths.front());
  for (const std::string& path : variable.paths) {
    const std::string other = unit_of(table, key, model, path);
    if (other != unit) {
      table.reject(key,
                   "joins a number in " + unit + " with " + path + " in " + other +
                       ", expected numbers of one unit");
    }
  }
  variable.lower = table.quantity("lower", unit);
  variable.upper = table.quantity("upper", unit);
  variable.initial = table.quantity("initial", unit);
  variable.unit = unit == "1" ? "1" : written_unit(table.text("initial"));
  variable.scale = table.choice("scale", {"linear", "logarithmic"}, "linear") == "linear"
                       ? Scale::linear
                       : Scale::logarithmic;
  return variable;
}

Document at(const Document& model, const DesignSpace& space, const DesignPoint& point) {
  assert(static_cast<int>(point.values.size()) == space.size());
  Document changed = model;
  for (int i = 0; i < space.size(); ++i) {
    for (const std::string& path : space[i].paths) changed.set(path, point.values[i]);
  }
  return changed;
}

}  // namespace latsch::correlation
