// SPDX-License-Identifier: Apache-2.0
// The conditions (load, camber, pressure, speed) that a coefficient of the Magic Formula
// multiplies, and their orders.
//
// For example, PPY4 is the factor of the square of the pressure's increment in the lateral
// friction, so two pressures do not determine it: a polynomial of order n needs n + 1 distinct
// levels. The terms are those of (4.E9) to (4.E78), (A48), (A54)-(A60) as in docs/magic_formula.md.
// The single term of an even function, 1 - PDY3 gamma^2 or 1 - PKY3 |gamma|, is of order 1 in the
// square or modulus: two cambers of one size to both sides do not determine it. A modulus in
// addition to gamma itself, as in 1 + QBZ4 gamma + QBZ5 |gamma|, can be separated from it only by
// cambers to both sides.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace latsch::magic_formula {

enum class Condition { load, camber, pressure, speed };

/// Returns the column of states that holds a condition: "Fz", "gamma", "p", "Vx".
const char* channel_of(Condition condition);
/// Returns "load", "camber", "pressure" or "speed".
const char* name_of(Condition condition);

struct ConditionOrder {
  Condition condition;
  int order = 1;
  bool is_even = false;           // order in its square or modulus
  bool needs_both_signs = false;  // both signs of the condition
};

/// Returns an empty list for a coefficient of no condition and for an unknown name.
std::vector<ConditionOrder> conditions_of(std::string_view coefficient);

/// The levels of a condition that a recording contains.
struct LevelsOfCondition {
  int count = 0, count_of_modulus = 0;
  bool has_both_signs = false;
  std::string words = "no record";  // "2 levels: 69, 83 kPa"
};

/// The levels of every condition; the index is that of the enumeration.
using ConditionLevels = std::array<LevelsOfCondition, 4>;

/// Returns why the levels cannot determine a coefficient: "of order 2 in the pressure, of which
/// there are 2 levels: 69, 83 kPa"; empty if they can.
std::string reason_against(std::string_view coefficient, const ConditionLevels& levels);

}  // namespace latsch::magic_formula
