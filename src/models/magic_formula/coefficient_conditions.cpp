// SPDX-License-Identifier: Apache-2.0
#include "models/magic_formula/coefficient_conditions.h"

#include <fmt/format.h>

namespace latsch::magic_formula {
namespace {

struct Row {
  std::string_view coefficient;
  Condition condition;
  int order;
  bool is_even = false, needs_both_signs = false;
};

using enum Condition;

constexpr Row kRows[] = {
    // Coefficients of Fx. Because of the product exp(PKX3 dfz) (1 + PKX2 dfz) the slip stiffness is
    // nonlinear in the load.
    {"PDX2", load, 1},
    {"PDX3", camber, 1, true},
    {"PEX2", load, 1},
    {"PEX3", load, 2},
    {"PKX2", load, 1},
    {"PKX3", load, 2},
    {"PHX2", load, 1},
    {"PVX2", load, 1},
    {"PPX1", pressure, 1},
    {"PPX2", pressure, 2},
    {"PPX3", pressure, 1},
    {"PPX4", pressure, 2},
    {"RBX3", camber, 1, true},
    {"REX2", load, 1},
    // Fy
    {"PDY2", load, 1},
    {"PDY3", camber, 1, true},
    {"PEY2", load, 1},
    {"PEY4", camber, 1},
    {"PEY5", camber, 1, true},
    {"PKY2", load, 1},
    {"PKY3", camber, 1, true},
    {"PKY4", load, 2},
    {"PKY5", camber, 1, true},
    {"PKY6", camber, 1},
    {"PKY7", camber, 1},
    {"PKY7", load, 1},
    {"PHY2", load, 1},
    {"PHY3", camber, 1},
    {"PVY2", load, 1},
    {"PVY3", camber, 1},
    {"PVY4", camber, 1},
    {"PVY4", load, 1},
    {"PPY1", pressure, 1},
    {"PPY2", pressure, 1},
    {"PPY2", load, 1},
    {"PPY3", pressure, 1},
    {"PPY4", pressure, 2},
    {"PPY5", pressure, 1},
    {"PPY5", camber, 1},
    {"RBY4", camber, 1, true},
    {"REY2", load, 1},
    {"RHY2", load, 1},
    {"RVY2", load, 1},
    {"RVY3", camber, 1},
    // Mz
    {"QBZ2", load, 1},
    {"QBZ3", load, 2},
    {"QBZ4", camber, 1},
    {"QBZ5", camber, 1, false, true},
    {"QDZ2", load, 1},
    {"QDZ3", camber, 1},
    {"QDZ4", camber, 2},
    {"QDZ7", load, 1},
    {"QDZ8", camber, 1},
    {"QDZ9", camber, 1},
    {"QDZ9", load, 1},
    {"QDZ10", camber, 2},
    {"QDZ11", camber, 2},
    {"QDZ11", load, 1},
    {"QEZ2", load, 1},
    {"QEZ3", load, 2},
    {"QEZ5", camber, 1},
    {"QHZ2", load, 1},
    {"QHZ3", camber, 1},
    {"QHZ4", camber, 1},
    {"QHZ4", load, 1},
    {"PPZ1", pressure, 1},
    {"PPZ2", pressure, 1},
    {"SSZ3", camber, 1},
    {"SSZ4", camber, 1},
    {"SSZ4", load, 1},
    // Coefficients of Mx and My, and of the decrease of friction with speed. At a single load QSX10
    // has the same effect as QSX2, and QSX13 the same as QSX3.
    {"QSX2", camber, 1},
    {"QSX10", camber, 1},
    {"QSX10", load, 1},
    {"QSX13", load, 1},
    {"QSX14", camber, 1, true},
    {"QSY3", speed, 1},
    {"QSY4", speed, 4},
    {"QSY5", camber, 1, true},
    {"QSY6", camber, 1, true},
    {"QSY6", load, 1},
    {"QSY7", load, 1},
    {"QSY8", pressure, 1},
    {"PPMX1", pressure, 1},
    {"PPMX1", camber, 1},
    {"LMUV", speed, 1},
};

}  // namespace

const char* channel_of(Condition condition) {
  constexpr const char* kChannels[] = {"Fz", "gamma", "p", "Vx"};
  return kChannels[static_cast<int>(condition)];
}

const char* name_of(Condition condition) {
  constexpr const char* kNames[] = {"load", "camber", "pressure", "speed"};
  return kNames[static_cast<int>(condition)];
}

std::vector<ConditionOrder> conditions_of(std::string_view coefficient) {
  std::vector<ConditionOrder> all;
  for (const Row& row : kRows)
    if (row.coefficient == coefficient)
      all.push_back({row.condition, row.order, row.is_even, row.needs_both_signs});
  return all;
}

std::string reason_against(std::string_view coefficient, const ConditionLevels& levels) {
  for (const ConditionOrder& one : conditions_of(coefficient)) {
    const LevelsOfCondition& there = levels[static_cast<std::size_t>(one.condition)];
    const char* condition = name_of(one.condition);
    if (there.count <= one.order)
      return fmt::format("of order {} in the {}, of which there {} {}",
                         one.order,
                         condition,
                         there.count > 1 ? "are" : "is",
                         there.words);
    if (one.is_even && there.count_of_modulus <= one.order)
      return fmt::format(
          "of an even function of the {}, which has one size: {}", condition, there.words);
    if (one.needs_both_signs && !there.has_both_signs)
      return fmt::format(
          "of the modulus of the {}, which has one sign: the term without modulus is the same",
          condition);
  }
  return "";
}

}  // namespace latsch::magic_formula
