// SPDX-License-Identifier: Apache-2.0
// The units of an .inp file. The language has none: a file is consistent in units of its own, which
// only its author knows.
//
// A comment, which other programs ignore, may state them:
//   ** units: mm, N, tonne                 of length, force, mass
// Without such a comment the size of the tire decides: a radius of 0.1 to 2 is in meters (m, N,
// kg), one of 100 to 2000 in millimeters (mm, N, tonne).
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace latsch::formats {

/// SI values of one unit of the file. Decks of tires are usually in mm, N, tonne, s.
struct InpUnits {
  double length = 1e-3;  // m
  double force = 1.0;    // N
  double mass = 1e3;     // kg
  bool operator==(const InpUnits&) const = default;
};

/// Quantity of a number of a deck.
enum class InpQuantity { ratio, stress, compliance, density, length, area, angle };

/// Returns one unit of the file in unit_of().
double factor_of(InpQuantity quantity, const InpUnits& units);
/// Returns "Pa", "1/Pa", "deg", ...
const char* unit_of(InpQuantity quantity);
/// Converts a number of the file to SI: an angle to rad.
double to_si(double value, InpQuantity quantity, const InpUnits& units);
/// Converts a number from SI to the units of the file.
double from_si(double value, InpQuantity quantity, const InpUnits& units);

/// Returns the units that a comment of the file states. Throws InputError if they are invalid.
std::optional<InpUnits> stated_units(std::string_view text, const std::string& file_name);
/// Returns the units of a tire whose outermost node has that distance from the axis, in units of
/// the file.
std::optional<InpUnits> units_of_size(double radius);
/// Returns "mm, N, tonne".
std::string in_words(const InpUnits& units);

}  // namespace latsch::formats
