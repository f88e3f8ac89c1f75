// SPDX-License-Identifier: Apache-2.0
// The spellings of units that files of tires, vehicles and rigs have, and their meanings.
//
// UDUNITS-2 knows 1,300 words and makes more by prefixes: "Grad" is a giga-radian there, "PS" a
// picosiemens, "H" a henry, "Ms" a megasecond. So every word of a unit has to stand in the list of
// this file, which gives its meaning in the language of UDUNITS; that library does the arithmetic.
// A word in another case counts where UDUNITS does not know it as something else.
//
// Between words stand blanks, `*`, `.`, `·`, `-` (products), `/` or `per`; exponents are `^2`,
// `**2`, `2`, `²`, `-1`. Full-width letters, the squared units of Japanese (㎜) and both code points
// of µ are read as the letters they stand for.
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
  /// In the language of UDUNITS; empty where the text is no unit.
  std::vector<std::string> texts;
  /// The same in words of the list, each with one meaning.
  std::vector<std::string> spellings;
  /// The first of the `texts` is not usual enough: the dimension has to tell.
  bool dimension_decides = false;
  /// For a refused text, behind its name: `which is ...; write "deg"`. Empty: the text is unknown.
  std::string refusal;
};

/// `is_foreign(word, meaning)` says whether UDUNITS knows `word` as something else than `meaning`.
UnitMeanings unit_meanings(
    std::string_view written,
    const std::function<bool(std::string_view word, const std::string& meaning)>& is_foreign);

}  // namespace latsch
