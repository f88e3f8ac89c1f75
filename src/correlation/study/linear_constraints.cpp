// SPDX-License-Identifier: Apache-2.0
#include "correlation/study/linear_constraints.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "base/units.h"

namespace latsch::correlation {
namespace {

size_t place_of(const Node& table,
                const std::string& name,
                const std::vector<DesignVariable>& variables) {
  std::vector<std::string> names;
  for (const DesignVariable& variable : variables) names.push_back(variable.name);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    table.reject("variables",
                 fmt::format("names {}, which is no variable of the study{}",
                             in_quotes(name),
                             did_you_mean(name, names)));
  }
  return static_cast<size_t>(found - names.begin());
}

/// Returns one coefficient for each of the variables named.
std::vector<double> read_coefficients(const Node& table, size_t count) {
  if (!table.has("coefficients")) return std::vector<double>(count, 1.0);
  std::vector<double> coefficients = table.quantities("coefficients", "1");
  if (coefficients.size() != count) {
    table.reject(
        "coefficients",
        fmt::format("are {} for {} variables, expected one each", coefficients.size(), count));
  }
  return coefficients;
}

void read_bounds(const Node& table, LinearConstraint& constraint) {
  if (table.has("equal")) {
    if (table.has("lower") || table.has("upper")) {
      table.reject("equal", "is given beside lower or upper, expected it alone");
    }
    constraint.lower = constraint.upper = table.quantity("equal", constraint.unit);
    return;
  }
  if (table.has("lower")) constraint.lower = table.quantity("lower", constraint.unit);
  if (table.has("upper")) constraint.upper = table.quantity("upper", constraint.unit);
}

}  // namespace

LinearConstraint read_linear_constraint(const Node& table,
                                        const std::vector<DesignVariable>& variables) {
  if (parse_number(table.name())) {  // the name is a position in a list of constraints
    throw InputError(table.place(),
                     "linear_constraint is a list of tables without names, [[linear_constraint]]; "
                     "expected a table with a name each, such as [linear_constraint.belt_sum]");
  }
  LinearConstraint constraint;
  constraint.name = table.name();
  constraint.place = table.place();
  constraint.coefficients.resize(variables.size(), 0.0);
  const std::vector<std::string> names = table.texts("variables");
  if (names.empty()) table.reject("variables", "is empty, expected at least one name");
  const std::vector<double> coefficients = read_coefficients(table, names.size());
  constraint.unit = variables[place_of(table, names.front(), variables)].unit;
  for (size_t k = 0; k < names.size(); ++k) {
    const size_t i = place_of(table, names[k], variables);
    if (!Unit::of(variables[i].unit).same_dimension(Unit::of(constraint.unit))) {
      table.reject("variables",
                   fmt::format("adds {} in {} to {} in {}, expected variables of one quantity",
                               names[k],
                               variables[i].unit,
                               names.front(),
                               constraint.unit));
    }
    constraint.coefficients[i] += coefficients[k];
  }
  read_bounds(table, constraint);
  return constraint;
}

std::string in_words(const LinearConstraint& constraint, const DesignSpace& space) {
  std::string sum;
  for (int i = 0; i < space.size(); ++i) {
    const double a = constraint.coefficients[i];
    if (a == 0.0) continue;
    const std::string sign = sum.empty() ? (a < 0.0 ? "-" : "") : (a < 0.0 ? " - " : " + ");
    const std::string factor = std::abs(a) == 1.0 ? "" : format_number(std::abs(a), 6) + " ";
    sum += sign + factor + space[i].name;
  }
  const auto bound = [&](double value) { return format_quantity(value, constraint.unit); };
  if (constraint.is_equation()) return sum + " = " + bound(constraint.lower);
  if (std::isfinite(constraint.lower)) sum = bound(constraint.lower) + " <= " + sum;
  if (std::isfinite(constraint.upper)) sum += " <= " + bound(constraint.upper);
  return sum;
}

}  // namespace latsch::correlation
