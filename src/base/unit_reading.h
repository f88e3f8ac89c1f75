// SPDX-License-Identifier: Apache-2.0
// Reads a unit as a person, a laboratory or a program writes it. All readers of files use these
// functions; unit_words.h says which spellings are known.
//
// A word may have several meanings: "lb" is a force where a force is expected, a mass where a mass
// is, and a force where the dimension is not known. "g", alone and without a dimension, is refused:
// a gram and the acceleration of gravity are equally likely.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/units.h"

namespace latsch {

struct UnitReading {
  std::optional<Unit> unit;
  std::string fault;    // without a unit: `unknown unit "mmm", did you mean "mm"?`, behind "has "
  std::string assumed;  // for a unit with several meanings, which one is taken, in words
};

/// Without knowing what is measured. An empty text is a plain number.
UnitReading reading_of_unit(std::string_view written);
/// Where a value of the dimension of `expected` is expected. The unit may still be of another
/// dimension: then no meaning of it fits.
UnitReading reading_of_unit(std::string_view written, const Unit& expected);

/// The same without words. The text of the unit is as written, or where the usual meaning does not
/// fit, the spelling of the one that does: "lbm" for "lb".
std::optional<Unit> find_unit(std::string_view written, const Unit& expected);

/// Whether a text is a unit, or a spelling of one that is refused in words ("grad", "psia").
bool looks_like_unit(std::string_view written);

/// A number and its unit where a value of the dimension of `expected` is expected.
std::optional<Quantity> parse_quantity(std::string_view text, const Unit& expected);

}  // namespace latsch
