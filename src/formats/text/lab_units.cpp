// SPDX-License-Identifier: Apache-2.0
#include "formats/text/lab_units.h"

#include <array>
#include <string>

#include "base/text.h"
#include "formats/text/letter_case.h"

namespace latsch::formats {
namespace {

struct Spelling {
  std::string_view written, unit;
};

/// What units.h would not know or take for something else.
constexpr std::array kMeant = {
    Spelling{"", "1"},           Spelling{"-", "1"},           Spelling{"--", "1"},
    Spelling{"none", "1"},       Spelling{"n/a", "1"},         Spelling{"nm", "Nm"},
    Spelling{"C", "degC"},       Spelling{"deg C", "degC"},    Spelling{"deg.C", "degC"},
    Spelling{"°C", "degC"},      Spelling{"grad C", "degC"},   Spelling{"Grad C", "degC"},
    Spelling{"deg F", "degF"},   Spelling{"°F", "degF"},       Spelling{"°", "deg"},
    Spelling{"degree", "deg"},   Spelling{"degrees", "deg"},   Spelling{"S", "s"},
    Spelling{"sec", "s"},        Spelling{"1/min", "rpm"},     Spelling{"U/min", "rpm"},
    Spelling{"rev/min", "rpm"},  Spelling{"min-1", "rpm"},     Spelling{"min^-1", "rpm"},
    Spelling{"mph", "mile/h"},   Spelling{"N-m", "Nm"},        Spelling{"N.m", "Nm"},
    Spelling{"ft-lb", "ft lbf"}, Spelling{"ft-lbf", "ft lbf"}, Spelling{"lbs", "lbf"},
    Spelling{"lb", "lbf"},       Spelling{"lb-ft", "ft lbf"},  Spelling{"deg/s", "deg/s"},
    Spelling{"newton", "N"},     Spelling{"meter", "m"},       Spelling{"m/sec", "m/s"},
};

/// Known in any case.
constexpr std::array<std::string_view, 31> kUsual = {
    "m",   "mm",  "cm",   "km",  "in",   "inch", "ft",  "N",   "kN", "daN", "Nm",
    "kNm", "Pa",  "kPa",  "hPa", "MPa",  "bar",  "psi", "s",   "ms", "h",   "min",
    "deg", "rad", "km/h", "kph", "degC", "K",    "kg",  "rpm", "m/s"};

std::string_view without_brackets(std::string_view text) {
  text = trimmed(text);
  const bool square = text.size() >= 2 && text.front() == '[' && text.back() == ']';
  const bool round = text.size() >= 2 && text.front() == '(' && text.back() == ')';
  return square || round ? trimmed(text.substr(1, text.size() - 2)) : text;
}

}  // namespace

std::optional<Unit> find_lab_unit(std::string_view text) {
  text = without_brackets(text);
  for (const Spelling& spelling : kMeant)
    if (spelling.written == text) return Unit::of(spelling.unit);
  if (auto unit = Unit::find(text)) return unit;
  const std::string any_case = lower(text);
  for (const std::string_view unit : kUsual)
    if (lower(unit) == any_case) return Unit::of(unit);
  for (const Spelling& spelling : kMeant)
    if (lower(spelling.written) == any_case) return Unit::of(spelling.unit);
  return std::nullopt;
}

}  // namespace latsch::formats
