// SPDX-License-Identifier: Apache-2.0
// Converts quantities with units, "2.6 bar", "22.3 N/mm^2", "22 deg", "1e-3 in", into SI and back.
//   SI value = number * factor + offset        (the offset is not 0 for "degC" and "degF")
// The units and their spelling are those of the UDUNITS-2 database of the system, with "deg",
// "rev", "Nm" and "kph" added. Unlike in UDUNITS, an angle has a dimension: "22 deg" is no plain
// number and "rpm" no frequency. Numbers are converted with 64 bits of mantissa and rounded once:
// "310 mm" gives the bits of 0.31, and every SI value has a text that reproduces its bits.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace latsch {

/// A unit of UDUNITS-2: its dimension, and its conversion to and from SI.
class Unit {
 public:
  /// Powers of m, kg, s, A, K, mol, cd, rad.
  using Dimension = std::array<int, 8>;

  /// Returns nothing if the text is no unit. Safe to call from any thread.
  static std::optional<Unit> find(std::string_view text);
  /// Returns a unit that the program's code names, so that it must exist.
  static Unit of(std::string_view text);

  /// The unit as it was written.
  const std::string& text() const { return text_; }
  /// Powers of the base units.
  const Dimension& dimension() const { return dimension_; }
  /// True if numbers in one unit can be converted into the other.
  bool same_dimension(const Unit& other) const { return dimension_ == other.dimension_; }
  /// True for a plain number, such as "1" or "%". An angle is not dimensionless.
  bool dimensionless() const { return dimension_ == Dimension{}; }

  /// Converts a number in this unit into SI.
  double to_si(long double number) const;
  /// Converts an SI value into this unit.
  double from_si(double value) const;
  /// Returns the number, without the unit, with the fewest digits for which to_si gives the bits of
  /// `value`.
  std::string exact_number(double value) const;
  /// Appends exact_number(value) to the text.
  void append_exact_number(double value, std::string& text) const;

 private:
  std::string text_;
  Dimension dimension_ = {};
  long double factor_ = 1.0L;
  long double offset_ = 0.0L;
};

/// A number and its unit as a person writes them.
struct Quantity {
  std::string number;  // unchanged text
  Unit unit;           // the unit as it was written
  double si = 0.0;     // the value in SI
};

/// Returns nothing if the text is not a number followed by a unit.
std::optional<Quantity> parse_quantity(std::string_view text);

/// The number at the beginning of a text and what follows it, both trimmed.
struct NumberAndRest {
  long double number = 0.0L;      // in the unit that follows the number
  std::string_view digits, rest;  // parts of the text: the number, and everything after it
};
/// Returns nullopt if the text does not begin with a number.
std::optional<NumberAndRest> split_number(std::string_view text);

/// Returns an SI value as a text in the given unit, such as "2.6 bar".
std::string format_quantity(double si, std::string_view unit, int digits = 6);

/// Returns the SI unit of a dimension: "Pa", "N/m", "kg/m^3".
std::string si_unit(const Unit::Dimension& dimension);

/// Noun and example of a quantity with a certain dimension: `an angle such as "22 deg"`.
struct DimensionWords {
  std::string noun;     // "an angle"
  std::string example;  // "22 deg"
};
/// Returns name and example of a quantity with the dimension of the unit.
DimensionWords words_for(const Unit& unit);

/// Returns the message `unknown unit "mmm", did you mean "mm"?`.
std::string unknown_unit(std::string_view unit);

}  // namespace latsch
