// SPDX-License-Identifier: Apache-2.0
// The polynomial factors of pressure and camber in the formulas, and the check that they stay
// positive: no pole, no change of sign.
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "models/magic_formula/sanity/sanity_checks.h"

namespace latsch::magic_formula {

const std::vector<Factor>& factors() {
  using P = Parameters;
  using enum Condition;
  static const std::vector<Factor> all = {
      {"of vertical stiffness",
       pressure,
       {"PFZ1"},
       [](const P& p, double x) { return 1.0 + p.PFZ1 * x; }},
      {"of slip stiffness",
       pressure,
       {"PPX1", "PPX2"},
       [](const P& p, double x) { return 1.0 + p.PPX1 * x + p.PPX2 * x * x; }},
      {"of longitudinal friction",
       pressure,
       {"PPX3", "PPX4"},
       [](const P& p, double x) { return 1.0 + p.PPX3 * x + p.PPX4 * x * x; }},
      {"of cornering stiffness",
       pressure,
       {"PPY1"},
       [](const P& p, double x) { return 1.0 + p.PPY1 * x; }},
      {"of the load of the largest cornering stiffness",
       pressure,
       {"PPY2"},
       [](const P& p, double x) { return 1.0 + p.PPY2 * x; }},
      {"of lateral friction",
       pressure,
       {"PPY3", "PPY4"},
       [](const P& p, double x) { return 1.0 + p.PPY3 * x + p.PPY4 * x * x; }},
      {"of camber stiffness",
       pressure,
       {"PPY5"},
       [](const P& p, double x) { return 1.0 + p.PPY5 * x; }},
      {"of the trail", pressure, {"PPZ1"}, [](const P& p, double x) { return 1.0 - p.PPZ1 * x; }},
      {"of the residual torque",
       pressure,
       {"PPZ2"},
       [](const P& p, double x) { return 1.0 + p.PPZ2 * x; }},
      {"of longitudinal friction",
       camber,
       {"PDX3"},
       [](const P& p, double x) { return 1.0 - p.PDX3 * x * x; }},
      {"of lateral friction",
       camber,
       {"PDY3"},
       [](const P& p, double x) { return 1.0 - p.PDY3 * x * x; }},
      {"of cornering stiffness",
       camber,
       {"PKY3"},
       [](const P& p, double x) { return 1.0 - p.PKY3 * std::abs(x); }},
      {"of the load of the largest cornering stiffness",
       camber,
       {"PKY5"},
       [](const P& p, double x) { return 1.0 + (p.PKY2 != 0.0 ? p.PKY5 / p.PKY2 : 0.0) * x * x; }},
      {"of the trail's stiffness factor",
       camber,
       {"QBZ4", "QBZ5"},
       [](const P& p, double x) { return 1.0 + p.QBZ4 * x + p.QBZ5 * std::abs(x); }},
      {"of the trail",
       camber,
       {"QDZ3", "QDZ4"},
       [](const P& p, double x) { return 1.0 + p.QDZ3 * x + p.QDZ4 * x * x; }},
  };
  return all;
}

WorstViolation stays_positive(const Parameters& p, const Lattice& at, const Factor& factor) {
  constexpr double kPaOfBar = 1e5, kDegreesOfRad = 180.0 / std::numbers::pi;
  const bool of_pressure = factor.condition == Condition::pressure;
  WorstViolation found;
  for (const double x : of_pressure ? at.pressures : at.cambers) {
    const double value = factor.value(p, of_pressure ? x / p.NOMPRES - 1.0 : x);
    if (value > 0.0) continue;
    found.worsen(1e-9 - value, [&] {
      return fmt::format("the {} factor {} is {:.3g} at {}",
                         name_of(factor.condition),
                         factor.words,
                         value,
                         of_pressure ? fmt::format("{:.2f} bar", x / kPaOfBar)
                                     : fmt::format("{:.1f} deg", x * kDegreesOfRad));
    });
  }
  return found;
}

}  // namespace latsch::magic_formula
