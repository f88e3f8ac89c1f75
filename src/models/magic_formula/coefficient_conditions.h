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

/// Returns the name of the column of states that holds a condition: "Fz", "gamma", "p", "Vx".
const char* channel_of(Condition condition);
/// Returns the name of a condition in messages: "load", "camber", "pressure" or "speed".
const char* name_of(Condition condition);

struct ConditionOrder {
  Condition condition;
  int order = 1;
  bool is_even = false;  // true: the order counts powers of the condition's square or modulus
  bool needs_both_signs = false;  // levels with both signs of the condition are needed
};

/// Returns the conditions that a coefficient multiplies, with their orders. Returns an empty list
/// for a coefficient that multiplies none and for an unknown name.
std::vector<ConditionOrder> conditions_of(std::string_view coefficient);

/// The different levels of one condition that a recording contains.
struct LevelsOfCondition {
  int count = 0, count_of_modulus = 0;
  bool has_both_signs = false;
  std::string words = "no record";  // "2 levels: 69, 83 kPa"
};

/// Levels of all conditions. The index is the value of the enumeration Condition.
using ConditionLevels = std::array<LevelsOfCondition, 4>;

/// Returns the reason why these levels cannot determine a coefficient, such as "of order 2 in the
/// pressure, of which there are 2 levels: 69, 83 kPa". Returns an empty text if they can.
std::string reason_against(std::string_view coefficient, const ConditionLevels& levels);

}  // namespace latsch::magic_formula
