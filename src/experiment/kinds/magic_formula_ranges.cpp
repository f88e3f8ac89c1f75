// SPDX-License-Identifier: Apache-2.0
#include "experiment/kinds/magic_formula_ranges.h"

#include <algorithm>

namespace latsch::experiment {
namespace {

struct NamedRange {
  std::string_view name;
  double lower, upper;
};

constexpr NamedRange kRanges[] = {
    // coefficients of the longitudinal force Fx
    {"PCX1", 1.0, 2.2},
    {"PDX1", 0.5, 4.0},
    {"PDX2", -1.0, 0.5},
    {"PDX3", -40, 40},
    {"PEX1", -10, 1},
    {"PEX2", -10, 10},
    {"PEX3", -5, 5},
    {"PEX4", -2, 2},
    {"PKX1", 4, 120},
    {"PKX2", -30, 30},
    {"PKX3", -2, 2},
    {"PHX1", -0.02, 0.02},
    {"PHX2", -0.02, 0.02},
    {"PVX1", -0.2, 0.2},
    {"PVX2", -0.2, 0.2},
    {"PPX1", -4, 4},
    {"PPX2", -4, 4},
    {"PPX3", -4, 4},
    {"PPX4", -8, 8},
    // coefficients of Fx in combined slip
    {"RBX1", 2, 40},
    {"RBX2", 0, 40},  // its sign does not matter
    {"RBX3", -1500, 1500},
    {"RCX1", 0.5, 2},
    {"REX1", -5, 1},
    {"REX2", -10, 10},
    {"RHX1", -0.05, 0.05},
    // coefficients of the lateral force Fy
    {"PCY1", 1.0, 2.2},
    {"PDY1", 0.5, 4.0},
    {"PDY2", -1.0, 0.5},
    {"PDY3", -40, 40},
    {"PEY1", -5, 1},
    {"PEY2", -5, 5},
    {"PEY3", -2, 2},
    {"PEY4", -60, 60},
    {"PEY5", -600, 600},
    {"PKY1", -150, -8},
    {"PKY2", 0.3, 8},
    {"PKY3", -6, 6},
    {"PKY4", 1, 3},
    {"PKY5", -60, 60},
    {"PKY6", -6, 3},
    {"PKY7", -4, 4},
    {"PHY1", -0.03, 0.03},
    {"PHY2", -0.03, 0.03},
    {"PVY1", -0.3, 0.3},
    {"PVY2", -0.3, 0.3},
    {"PVY3", -4, 4},
    {"PVY4", -4, 4},
    {"PPY1", -4, 4},
    {"PPY2", -4, 4},
    {"PPY3", -2, 2},
    {"PPY4", -8, 8},
    {"PPY5", -8, 8},
    // coefficients of Fy in combined slip
    {"RBY1", 2, 40},
    // the sign of this coefficient hardly matters, and with both signs there would be a second
    // minimum
    {"RBY2", 0, 40},
    {"RBY3", -0.5, 0.5},
    {"RBY4", -4000, 4000},
    {"RCY1", 0.5, 2},
    {"REY1", -5, 1},
    {"REY2", -5, 5},
    {"RHY1", -0.1, 0.1},
    {"RHY2", -0.1, 0.1},
    {"RVY1", -0.3, 0.3},
    {"RVY2", -0.3, 0.3},
    {"RVY3", -4, 4},
    {"RVY4", -200, 200},
    {"RVY5", -4, 4},
    {"RVY6", -60, 60},
    // coefficients of the overturning moment Mx
    {"QSX1", -0.1, 0.1},
    {"QSX2", -20, 20},
    {"QSX3", -4, 4},
    {"QSX10", -20, 20},
    {"QSX13", -0.5, 0.5},
    {"QSX14", -5, 5},
    // My
    {"QSY1", 0, 0.05},
    {"QSY3", -0.05, 0.05},
    {"QSY4", -0.01, 0.01},
    // coefficients of the aligning moment Mz
    {"QBZ1", 1, 40},
    {"QBZ2", -20, 20},
    {"QBZ3", -20, 20},
    {"QBZ4", -15, 15},
    {"QBZ5", -15, 15},
    {"QBZ9", 0, 80},
    {"QBZ10", -8, 8},
    {"QCZ1", 0.6, 2.5},
    {"QDZ1", 0.01, 0.5},
    {"QDZ2", -0.4, 0.4},
    {"QDZ3", -15, 15},
    {"QDZ4", -200, 200},
    {"QDZ6", -0.08, 0.08},
    {"QDZ7", -0.08, 0.08},
    {"QDZ8", -4, 4},
    {"QDZ9", -4, 4},
    {"QDZ10", -40, 40},
    {"QDZ11", -40, 40},
    {"QEZ1", -10, 1},
    {"QEZ2", -10, 10},
    {"QEZ3", -15, 15},
    {"QEZ4", -4, 4},
    {"QEZ5", -40, 40},
    {"QHZ1", -0.08, 0.08},
    {"QHZ2", -0.08, 0.08},
    {"QHZ3", -3, 3},
    {"QHZ4", -3, 3},
    {"PPZ1", -4, 4},
    {"PPZ2", -6, 6},
    {"SSZ1", -0.2, 0.2},
    {"SSZ2", -0.2, 0.2},
    {"SSZ3", -4, 4},
    {"SSZ4", -4, 4},
    // stiffness of the carcass in the road plane, N/m; relaxation length = slip stiffness / this
    // stiffness
    {"LONGITUDINAL_STIFFNESS", 3e4, 3e6},
    {"LATERAL_STIFFNESS", 2e4, 2e6},
};

}  // namespace

std::optional<UsualRange> usual_range_of(std::string_view coefficient) {
  const auto found =
      std::find_if(std::begin(kRanges), std::end(kRanges), [&](const NamedRange& range) {
        return range.name == coefficient;
      });
  if (found == std::end(kRanges)) return std::nullopt;
  return UsualRange{found->lower, found->upper};
}

}  // namespace latsch::experiment
