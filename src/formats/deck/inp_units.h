// SPDX-License-Identifier: Apache-2.0
// The units of an .inp file. The language has none: a file is consistent in units of its own, and
// what they are is known to its author alone.
//
// A comment may say them, which other programs pass over:
//   ** units: mm, N, tonne                 of length, force, mass
// Without it the size of the tire tells: a radius of 0.1 to 2 is one in meters (m, N, kg), of 100
// to 2000 one in millimeters (mm, N, tonne).
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace latsch::formats {

/// What one unit of the file is in SI. Decks of tires are usually written in mm, N, tonne, s.
struct InpUnits {
  double length = 1e-3;  // m
  double force = 1.0;    // N
  double mass = 1e3;     // kg
  bool operator==(const InpUnits&) const = default;
};

/// What a number of a deck is.
enum class InpQuantity { ratio, stress, compliance, density, length, area, angle };

/// One unit of the file in `unit_of()`.
double factor_of(InpQuantity quantity, const InpUnits& units);
/// "Pa", "1/Pa", "deg", ...
const char* unit_of(InpQuantity quantity);
/// The number of the file in SI: an angle in rad.
double to_si(double value, InpQuantity quantity, const InpUnits& units);
/// And back.
double from_si(double value, InpQuantity quantity, const InpUnits& units);

/// The units a comment of the file states. Throws InputError where they are none.
std::optional<InpUnits> stated_units(std::string_view text, const std::string& file_name);
/// Those of a tire whose outermost node lies that far from the axis, in units of the file.
std::optional<InpUnits> units_of_size(double radius);
/// "mm, N, tonne"
std::string in_words(const InpUnits& units);

}  // namespace latsch::formats
