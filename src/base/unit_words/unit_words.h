// SPDX-License-Identifier: Apache-2.0
// The spellings of units in files of tires, vehicles and rigs, and their meanings.
//
// UDUNITS-2 knows 1,300 words and forms more by prefixes: it reads "Grad" as a giga-radian, "PS" as
// a picosiemens, "H" as a henry, "Ms" as a megasecond. So every word of a unit has to be in the
// list of unit_list.h, which gives its meaning in the language of UDUNITS; UDUNITS does the
// arithmetic. A word of the list is also accepted in another letter case, unless UDUNITS reads that
// spelling as another unit.
//
// Words are separated by blanks, `*`, `.`, `·`, `-` (products), `/` or `per`; exponents are `^2`,
// `**2`, `2`, `²`, `-1`. Full-width letters, the Japanese characters for squared units (㎜) and both
// code points of µ are read as the letters they stand for.
//
// Some spellings have several meanings ("lb" is a force and a mass). All are returned, the usual
// one first.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace latsch {

struct UnitMeanings {
  /// Meanings in the language of UDUNITS; empty if the text is no unit.
  std::vector<std::string> texts;
  /// Spellings of the meanings with words of the list that have a single meaning each.
  std::vector<std::string> spellings;
  /// True if the first of the `texts` is not usual enough, so that the dimension has to decide.
  bool dimension_decides = false;
  /// Explanation for a refused text, to follow its name: `which is ...; write "deg"`. Empty if the
  /// text is unknown.
  std::string refusal;
};

/// Returns the meanings of the unit `written`. `is_foreign(word, meaning)` returns true if UDUNITS
/// reads `word` as a unit other than `meaning`.
UnitMeanings unit_meanings(
    std::string_view written,
    const std::function<bool(std::string_view word, const std::string& meaning)>& is_foreign);

}  // namespace latsch
