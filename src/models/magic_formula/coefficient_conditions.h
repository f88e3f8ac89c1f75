// SPDX-License-Identifier: Apache-2.0
// Which condition a coefficient of the Magic Formula stands before, and in which order.
//
// PPY4 is the factor of the square of the pressure's increment in the lateral friction, so two
// pressures tell nothing of it: a polynomial of order n needs n + 1 distinct levels. Terms are
// those of (4.E9) to (4.E78), (A48), (A54)-(A60) as docs/magic_formula.md has them. The only
// term of an even function, 1 - PDY3 gamma^2 or 1 - PKY3 |gamma|, is of order 1 in the square or
// modulus: two cambers of one size to both sides do not tell it. A modulus beside gamma itself,
// as in 1 + QBZ4 gamma + QBZ5 |gamma|, is told apart from that by cambers to both sides alone.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace latsch::magic_formula {

enum class Condition { load, camber, pressure, speed };

/// The column of states that holds a condition: "Fz", "gamma", "p", "Vx".
const char* channel_of(Condition condition);
/// "load", "camber", "pressure", "speed".
const char* name_of(Condition condition);

struct ConditionOrder {
  Condition condition;
  int order = 1;
  bool is_even = false;           // of its square or modulus
  bool needs_both_signs = false;  // of the condition
};

/// Empty for a coefficient of no condition, and for a name that is none.
std::vector<ConditionOrder> conditions_of(std::string_view coefficient);

/// The levels that a recording has of a condition.
struct LevelsOfCondition {
  int count = 0, count_of_modulus = 0;
  bool has_both_signs = false;
  std::string words = "no record";  // "2 levels: 69, 83 kPa"
};

/// Of every condition; the place is that of the enumeration.
using ConditionLevels = std::array<LevelsOfCondition, 4>;

/// Why the levels cannot tell a coefficient: "of order 2 in the pressure, of which there are 2
/// levels: 69, 83 kPa"; empty where they can.
std::string reason_against(std::string_view coefficient, const ConditionLevels& levels);

}  // namespace latsch::magic_formula
