// SPDX-License-Identifier: Apache-2.0
// The units of an .inp file. The language has no units: the numbers of a file are consistent in a
// unit system that only its author knows.
//
// A comment, which other programs ignore, may state it:
//   ** units: mm, N, tonne                 of length, force, mass
// Without such a comment the size of the tire decides: a radius of 0.1 to 2 is in meters (m, N,
// kg), one of 100 to 2000 in millimeters (mm, N, tonne).
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace latsch::formats {

/// SI values of the units of the file. The defaults, mm, N, tonne and s, are usual for decks of
/// tires.
struct InpUnits {
  double length = 1e-3;  // m
  double force = 1.0;    // N
  double mass = 1e3;     // kg
  bool operator==(const InpUnits&) const = default;
};

/// Kind of quantity of a number in a deck.
enum class InpQuantity { ratio, stress, compliance, density, length, area, angle, time };

/// Returns the factor that converts a number of the file to the unit that unit_of() returns.
double factor_of(InpQuantity quantity, const InpUnits& units);
/// Returns the unit that users see for the quantity: "Pa", "1/Pa", "deg", ...
const char* unit_of(InpQuantity quantity);
/// Converts a number of the file to SI: an angle to rad.
double to_si(double value, InpQuantity quantity, const InpUnits& units);
/// Converts a number from SI to the units of the file.
double from_si(double value, InpQuantity quantity, const InpUnits& units);

/// Returns the units that a comment of the file states. Throws InputError if they are invalid.
std::optional<InpUnits> stated_units(std::string_view text, const std::string& file_name);
/// Returns the units of a tire whose outermost node has the distance `radius`, in units of the
/// file, from the axis; nullopt if no unit gives the size of a tire.
std::optional<InpUnits> units_of_size(double radius);
/// Returns the units as text, such as "mm, N, tonne".
std::string in_words(const InpUnits& units);

}  // namespace latsch::formats
