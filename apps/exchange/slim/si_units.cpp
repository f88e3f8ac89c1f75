// SPDX-License-Identifier: Apache-2.0
// The units of a slim library in the place of those of base/units.cpp: coherent SI alone, without a
// list of units and without files of the machine. slim_parts.h explains why.
//
//   unit      product of factors, or a quotient of two products: "N m", "kg/m^3", "N m/rad",
//             "rad/(N m)", "1/m"; a decimal factor may stand before it, "0.001 m"
//   factor    m kg s A K mol cd rad N Pa Hz W J 1, with a power of at most two digits: "m^2",
//             "s^-2"
//
// Numbers are read by from_chars of double, which knows no locale; the writer of the files
// (formats/text/document_si.h) states digits that give back the bits of a double.
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdlib>

#include "base/error.h"
#include "base/text.h"
#include "base/unit_reading.h"
#include "base/units.h"

namespace latsch {
namespace {

using Dimension = Unit::Dimension;

struct SiName {
  const char* name;
  Dimension dimension;  // powers of m, kg, s, A, K, mol, cd, rad
};
constexpr SiName kSiNames[] = {{"m", {1}},
                               {"kg", {0, 1}},
                               {"s", {0, 0, 1}},
                               {"A", {0, 0, 0, 1}},
                               {"K", {0, 0, 0, 0, 1}},
                               {"mol", {0, 0, 0, 0, 0, 1}},
                               {"cd", {0, 0, 0, 0, 0, 0, 1}},
                               {"rad", {0, 0, 0, 0, 0, 0, 0, 1}},
                               {"N", {1, 1, -2}},
                               {"Pa", {-1, 1, -2}},
                               {"Hz", {0, 0, -1}},
                               {"W", {2, 1, -3}},
                               {"J", {2, 1, -2}},
                               {"1", {}}};

/// Units in which messages of the program state a value.
constexpr struct {
  const char* name;
  const char* si;
  double factor;
} kInMessages[] = {{"mm", "m", 1e-3},
                   {"kPa", "Pa", 1e3},
                   {"bar", "Pa", 1e5},
                   {"kN", "N", 1e3},
                   {"km/h", "m/s", 1.0 / 3.6},
                   {"deg", "rad", 0.017453292519943295}};

/// Reads a unit from left to right.
class UnitParser {
 public:
  explicit UnitParser(std::string_view text) : rest_(text) {}

  std::optional<Dimension> run() {
    Dimension dimension{};
    if (!product(1, dimension)) return std::nullopt;
    if (take('/') && !(take('(') ? product(-1, dimension) && take(')') : product(-1, dimension)))
      return std::nullopt;
    skip_blanks();
    return rest_.empty() ? std::optional(dimension) : std::nullopt;
  }

 private:
  void skip_blanks() {
    while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == '.')) rest_.remove_prefix(1);
  }
  bool take(char c) {
    skip_blanks();
    if (rest_.empty() || rest_.front() != c) return false;
    rest_.remove_prefix(1);
    return true;
  }
  bool product(int sign, Dimension& dimension) {
    bool any = false;
    for (;; any = true) {
      skip_blanks();
      if (rest_.empty() || rest_.front() == '/' || rest_.front() == ')') return any;
      if (!factor(sign, dimension)) return false;
    }
  }
  bool factor(int sign, Dimension& dimension) {
    std::size_t length = 0;
    while (length < rest_.size() && is_of_name(rest_[length])) ++length;
    const std::string_view name = rest_.substr(0, length);
    rest_.remove_prefix(length);
    int power = 1;
    if (!rest_.empty() && rest_.front() == '^') {
      const auto [end, error] =
          std::from_chars(rest_.data() + 1, rest_.data() + rest_.size(), power);
      if (error != std::errc{} || std::abs(power) > 99) return false;
      rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    }
    for (const SiName& known : kSiNames) {
      if (name != known.name) continue;
      for (std::size_t i = 0; i < dimension.size(); ++i)
        dimension[i] += sign * power * known.dimension[i];
      return true;
    }
    return false;
  }
  static bool is_of_name(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '1';
  }

  std::string_view rest_;
};

}  // namespace

std::optional<Unit> Unit::find(std::string_view text) {
  text = trimmed(text);
  Unit unit;
  unit.text_ = text;
  // "0.001 m": a number that a blank separates from a unit
  double factor = 1.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), factor);
  const auto length = static_cast<std::size_t>(end - text.data());
  if (error == std::errc{} && length < text.size() && text[length] == ' ') {
    if (!(factor > 0.0)) return std::nullopt;
    unit.factor_ = factor;
    text = trimmed(text.substr(length));
  }
  const auto dimension = UnitParser(text).run();
  if (!dimension) return std::nullopt;
  unit.dimension_ = *dimension;
  return unit;
}

Unit Unit::of(std::string_view text) {
  if (const auto unit = find(text)) return *unit;
  for (const auto& known : kInMessages) {
    if (text != known.name) continue;
    Unit unit = *find(known.si);
    unit.text_ = text;
    unit.factor_ = known.factor;
    return unit;
  }
  throw InputError(unknown_unit(text));
}

double Unit::to_si(long double number) const { return static_cast<double>(number * factor_); }

double Unit::from_si(double value) const { return static_cast<double>(value / factor_); }

std::string Unit::exact_number(double value) const { return fmt::format("{}", from_si(value)); }

void Unit::append_exact_number(double value, std::string& text) const {
  text += exact_number(value);
}

std::optional<NumberAndRest> split_number(std::string_view text) {
  text = trimmed(text);
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{}) return std::nullopt;
  const auto length = static_cast<std::size_t>(end - text.data());
  return NumberAndRest{number, text.substr(0, length), trimmed(text.substr(length))};
}

std::optional<Quantity> parse_quantity(std::string_view text) {
  const auto parts = split_number(text);
  if (!parts) return std::nullopt;
  const auto unit = Unit::find(parts->rest);
  if (!unit) return std::nullopt;
  return Quantity{std::string(parts->digits), *unit, unit->to_si(parts->number)};
}

std::optional<Quantity> parse_quantity(std::string_view text, const Unit&) {
  return parse_quantity(text);
}

std::optional<Unit> find_unit(std::string_view written, const Unit&) { return Unit::find(written); }

bool looks_like_unit(std::string_view written) { return Unit::find(written).has_value(); }

UnitReading reading_of_unit(std::string_view written) {
  const auto unit = Unit::find(written.empty() ? "1" : written);
  if (!unit) return {std::nullopt, unknown_unit(written), ""};
  return {unit, "", ""};
}

UnitReading reading_of_unit(std::string_view written, const Unit&) {
  return reading_of_unit(written);
}

std::string format_quantity(double si, std::string_view unit, int digits) {
  const std::string number = format_number(Unit::of(unit).from_si(si), digits);
  return unit == "1" ? number : number + " " + std::string(unit);
}

std::string si_unit(const Unit::Dimension& dimension) {
  for (const SiName& known : kSiNames)
    if (dimension == known.dimension) return known.name;
  std::string text;
  for (std::size_t i = 0; i < dimension.size(); ++i) {
    if (dimension[i] == 0) continue;
    if (!text.empty()) text += ' ';
    text += kSiNames[i].name;
    if (dimension[i] != 1) text += fmt::format("^{}", dimension[i]);
  }
  return text;
}

DimensionWords words_for(const Unit& unit) {
  const std::string si = si_unit(unit.dimension());
  if (si == "1") return {"a plain number", "0.5"};
  return {"a quantity in " + si, "1 " + si};
}

std::string unknown_unit(std::string_view unit) {
  return "unit " + in_quotes(unit) +
         " is none of this unit's files: expected SI, as latsch export writes it";
}

}  // namespace latsch
