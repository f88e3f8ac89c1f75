// SPDX-License-Identifier: Apache-2.0
#include "formats/deck/inp_units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/error.h"
#include "base/text.h"
#include "base/unit_reading.h"
#include "formats/text/letter_case.h"

namespace latsch::formats {
namespace {

constexpr InpUnits kInMillimeters{1e-3, 1.0, 1e3};
constexpr InpUnits kInMeters{1.0, 1.0, 1.0};
constexpr std::string_view kStatement = "** units:";

std::string_view without_blanks(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// Reads the units of length, force and mass after the colon.
InpUnits parse_units(std::string_view text, const Place& place) {
  constexpr const char* kSi[3] = {"m", "N", "kg"};
  InpUnits units;
  double* const members[3] = {&units.length, &units.force, &units.mass};
  int count = 0;
  for (std::size_t begin = 0; begin <= text.size() && count < 4; ++count) {
    const std::size_t comma = std::min(text.find(',', begin), text.size());
    const std::string_view name = without_blanks(text.substr(begin, comma - begin));
    begin = comma + 1;
    if (count == 3) break;
    const auto unit = find_unit(name, Unit::of(kSi[count]));
    if (!unit || !unit->same_dimension(Unit::of(kSi[count])))
      throw InputError(
          place,
          fmt::format("{} is not a unit of {}, expected units of length, force and mass "
                      "such as \"** units: mm, N, tonne\"",
                      in_quotes(name),
                      count == 0   ? "length"
                      : count == 1 ? "force"
                                   : "mass"));
    *members[count] = unit->to_si(1.0L);
  }
  if (count != 3)
    throw InputError(place, "expected three units, such as \"** units: mm, N, tonne\"");
  return units;
}

}  // namespace

double factor_of(InpQuantity quantity, const InpUnits& units) {
  const double area = units.length * units.length, stress = units.force / area;
  switch (quantity) {
    case InpQuantity::stress:
      return stress;
    case InpQuantity::compliance:
      return 1.0 / stress;
    case InpQuantity::density:
      return units.mass / (area * units.length);
    case InpQuantity::length:
      return units.length;
    case InpQuantity::area:
      return area;
    case InpQuantity::time:  // force = mass length/time^2
      return std::sqrt(units.mass * units.length / units.force);
    case InpQuantity::ratio:
    case InpQuantity::angle:
      break;
  }
  return 1.0;
}

const char* unit_of(InpQuantity quantity) {
  switch (quantity) {
    case InpQuantity::stress:
      return "Pa";
    case InpQuantity::compliance:
      return "1/Pa";
    case InpQuantity::density:
      return "kg/m^3";
    case InpQuantity::length:
      return "m";
    case InpQuantity::area:
      return "m^2";
    case InpQuantity::time:
      return "s";
    case InpQuantity::angle:
      return "deg";
    case InpQuantity::ratio:
      break;
  }
  return "1";
}

double to_si(double value, InpQuantity quantity, const InpUnits& units) {
  if (quantity == InpQuantity::angle) return Unit::of("deg").to_si(value);
  return value * factor_of(quantity, units);
}

double from_si(double value, InpQuantity quantity, const InpUnits& units) {
  if (quantity == InpQuantity::angle) return Unit::of("deg").from_si(value);
  return value / factor_of(quantity, units);
}

std::optional<InpUnits> stated_units(std::string_view text, const std::string& file_name) {
  std::optional<InpUnits> units;
  int line = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    ++line;
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view one = text.substr(begin, end - begin);
    begin = end + 1;
    if (!one.starts_with("**") || one.size() < kStatement.size()) continue;
    if (lower(one.substr(0, kStatement.size())) != kStatement) continue;
    const InpUnits said = parse_units(one.substr(kStatement.size()), {file_name, line});
    if (units && *units != said)
      throw InputError({file_name, line}, "other units than above, expected the same");
    units = said;
  }
  return units;
}

std::optional<InpUnits> units_of_size(double radius) {
  if (radius >= 0.1 && radius <= 2.0) return kInMeters;
  if (radius >= 100.0 && radius <= 2000.0) return kInMillimeters;
  return std::nullopt;
}

std::string in_words(const InpUnits& units) {
  const auto name = [](double si, std::initializer_list<const char*> known, const char* si_unit) {
    for (const char* unit : known)
      if (Unit::of(unit).to_si(1.0L) == si) return std::string(unit);
    return fmt::format("{} {}", si, si_unit);
  };
  return fmt::format("{}, {}, {}",
                     name(units.length, {"m", "mm", "cm", "inch"}, "m"),
                     name(units.force, {"N", "kN", "mN"}, "N"),
                     name(units.mass, {"kg", "tonne", "g"}, "kg"));
}

}  // namespace latsch::formats
