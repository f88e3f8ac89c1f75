// SPDX-License-Identifier: Apache-2.0
#include "models/magic_formula/tree/rolling_formula.h"

#include <fmt/format.h>

#include <cmath>

#include "base/error.h"
#include "base/units.h"
#include "models/magic_formula/tree/parameter_tree.h"

namespace latsch::magic_formula {

std::string no_pressure_in_words() {
  return "the tire's file has no coefficient of the pressure (PFZ1, PPX1 to PPX4, PPY1 to PPY5, "
         "PPZ1, PPZ2 ... are 0), so its forces are those at its own pressure";
}

RollingFormula::RollingFormula(const Document& numbers)
    : parameters_(parameters_of(numbers)), file_(numbers.file()) {}

MagicFormulaTireSettings RollingFormula::settings_at(const Inflation& pressure) const {
  MagicFormulaTireSettings settings;
  settings.pressure = pressure.value_or(settings.pressure);
  settings.log = log_;
  if (pressure) asked_pressure_ = pressure;
  refuse_soft_pressure(pressure.value_or(parameters_.INFLPRES), {file_, 0});
  return settings;
}

std::unique_ptr<Tire> RollingFormula::tire(const Inflation& pressure) const {
  return std::make_unique<MagicFormulaTire>(parameters_, settings_at(pressure));
}

std::vector<std::string> RollingFormula::limits_met() const {
  auto sentences = ranges_left(log_->inputs(), parameters_);
  // At rest and below VXLOW the tire also depends on values that the file does not state.
  const auto speed = log_->inputs().speed;
  if (speed.to > 0.0 && speed.from < low_speed(parameters_))
    for (const std::string& assumed : assumed_at_standstill(parameters_))
      sentences.push_back("assumed for the wheel that hardly rolls in this test: " + assumed);
  constexpr double kRounding = 1e-9;
  const double own = parameters_.INFLPRES;
  if (asked_pressure_ && std::abs(*asked_pressure_ - own) > kRounding * own &&
      !pressure_acts(parameters_))
    sentences.push_back("the pressure of the test has no effect: " + no_pressure_in_words());
  return sentences;
}

void RollingFormula::refuse_soft_pressure(double pressure, const Place& place) const {
  const Parameters& p = parameters_;
  const double factor = 1.0 + p.PFZ1 * (pressure / p.NOMPRES - 1.0);
  if (p.PFZ1 == 0.0 || factor > 0.0) return;
  throw InputError(
      place,
      fmt::format("the tire has no vertical stiffness at {}: its factor 1 + PFZ1 dpi is {:.3g}, "
                  "with PFZ1 = {:g} and dpi = p / NOMPRES - 1; expected a pressure above {}, or a "
                  "smaller PFZ1",
                  format_quantity(pressure, "kPa", 4),
                  factor,
                  p.PFZ1,
                  format_quantity(p.NOMPRES * (1.0 - 1.0 / p.PFZ1), "kPa", 4)));
}

}  // namespace latsch::magic_formula
