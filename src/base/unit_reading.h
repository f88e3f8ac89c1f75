// SPDX-License-Identifier: Apache-2.0
// Reads a unit as a person, a laboratory or a program writes it. All readers of files use these
// functions; unit_words.h lists the spellings.
//
// A word may have several meanings: "lb" is a force if a force is expected, a mass if a mass is
// expected, and a force if the expected dimension is not known. "g", alone and without an expected
// dimension, is refused: a gram and the acceleration of gravity are equally likely.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/units.h"

namespace latsch {

struct UnitReading {
  std::optional<Unit> unit;
  /// Message if there is no unit: `unknown unit "mmm", did you mean "mm"?`, to follow "has ".
  std::string fault;
  std::string assumed;  // for a unit with several meanings: the meaning chosen, in words
};

/// Reads a unit whose dimension is not known in advance. An empty text is a plain number.
UnitReading reading_of_unit(std::string_view written);
/// Reads a unit if a value of the dimension of `expected` is expected. The result may be of another
/// dimension: then no meaning of the word fits.
UnitReading reading_of_unit(std::string_view written, const Unit& expected);

/// Returns the unit without explanations. Its text is as written, or, if the usual meaning does not
/// fit, the spelling of the meaning that does: "lbm" for "lb".
std::optional<Unit> find_unit(std::string_view written, const Unit& expected);

/// True if a text is a unit, or a spelling that is refused with an explanation ("grad", "psia").
bool looks_like_unit(std::string_view written);

/// Reads a number and its unit; `expected` has the dimension of the expected value.
std::optional<Quantity> parse_quantity(std::string_view text, const Unit& expected);

}  // namespace latsch
