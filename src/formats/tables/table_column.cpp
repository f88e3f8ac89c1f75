// SPDX-License-Identifier: Apache-2.0
#include "formats/tables/table_column.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/text.h"
#include "base/unit_reading.h"
#include "formats/text/letter_case.h"
#include "measurement/meaning/natural_unit.h"

namespace latsch::formats {
namespace {

constexpr std::size_t kMostNamed = 30;  // largest number of names in a message
// largest number of names among which the most similar one is searched
constexpr std::size_t kMostCompared = 1000;

/// True if the text in round brackets is a unit. Some letters in round brackets name a frame, a
/// side or an axle instead.
bool is_unit_in_round_brackets(std::string_view unit, std::string_view name) {
  if (unit.empty() || unit == "1" || unit == "-") return unit == "-";
  if (unit.size() == 1 &&
      ((unit[0] >= 'A' && unit[0] <= 'Z') || (unit[0] >= 'a' && unit[0] <= 'z'))) {
    if (unit == "C" || unit == "F" || unit == "K") return lower(name).find("temp") != name.npos;
    return unit == "N" || unit == "m" || unit == "s" || unit == "g" || unit == "V";
  }
  return looks_like_unit(unit);
}

/// Returns the unit that a message proposes instead of `written`. If a force is expected, a mass
/// most likely means the weight of that mass: "kgf" for "kg", "kgf m" for "kg m".
std::string unit_to_propose(std::string_view written, const std::string& expected) {
  using Pair = std::pair<std::string_view, std::string_view>;
  for (const auto& [mass, force] :
       {Pair{"kg", "kgf"}, Pair{"lbm", "lbf"}, Pair{"tonne", "tf"}, Pair{"t", "tf"}}) {
    if (!written.starts_with(mass)) continue;
    const std::string weight = std::string(force) + std::string(written.substr(mass.size()));
    const auto unit = Unit::find(weight);
    if (unit && unit->same_dimension(Unit::of(expected))) return weight;
  }
  return natural_unit(expected);
}

/// Converts the full-width letters, digits and brackets of Japanese text to ASCII.
std::string narrow_letters(std::string_view text) {
  constexpr std::size_t kBytes = 3;
  std::string narrow;
  while (!text.empty()) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const bool is_long = text.size() >= kBytes;
    const int code = is_long && (byte(0) & 0xf0) == 0xe0
                         ? ((byte(0) & 0x0f) << 12) | ((byte(1) & 0x3f) << 6) | (byte(2) & 0x3f)
                         : 0;
    // these full-width characters are in the order of ASCII
    const bool is_letter = code >= 0xff01 && code <= 0xff5e;
    if (is_letter || code == 0x3000) {
      narrow += is_letter ? static_cast<char>(code - 0xff01 + '!') : ' ';
      text.remove_prefix(kBytes);
      continue;
    }
    narrow += text.front();
    text.remove_prefix(1);
  }
  return narrow;
}

/// Returns what a unit of another dimension most likely means if an angle is expected.
std::string about_unit_of_angle(const TableColumn& column, const Unit& unit) {
  const std::string written = lower(column.unit);
  if (unit.same_dimension(Unit::of("s"))) {
    if (written == "min" || written == "mn") return " (minutes of arc are \"arcmin\")";
    if (written == "s" || written == "sec") return " (seconds of arc are \"arcsec\")";
  }
  if (unit.same_dimension(Unit::of("m")) && lower(column.name).find("toe") != column.name.npos)
    return " (a toe in millimeters depends on the diameter d at which it was measured: its angle "
           "is asin(toe / d), or half of that for the toe of both wheels)";
  return "";
}

std::string called_column(const TableColumn& column) { return "column " + in_quotes(column.name); }

/// True if the mark is a thousands separator, as in "1,234": one to three digits, the mark, three
/// digits.
bool is_group(std::string_view number, std::size_t mark) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  std::string_view before = number.substr(0, mark), behind = number.substr(mark + 1);
  if (!before.empty() && (before.front() == '-' || before.front() == '+')) before.remove_prefix(1);
  return !before.empty() && before.size() <= 3 && before != "0" && behind.size() == 3 &&
         std::all_of(before.begin(), before.end(), is_digit) &&
         std::all_of(behind.begin(), behind.end(), is_digit);
}

/// Returns the unit after a number in a cell, such as kPa in "83 kPa" or mm in "2,5 mm"; empty if
/// the cell has none.
std::string unit_in_cell(std::string_view cell) {
  const std::size_t end = cell.find_first_not_of("+-0123456789.,eE ");
  if (end == cell.npos || end == 0 || cell.substr(0, end).find_first_of("0123456789") == cell.npos)
    return "";
  const std::string_view unit = trimmed(cell.substr(end));
  return Unit::find(unit) ? std::string(unit) : "";
}

bool is_number_with(std::string_view cell, char decimal) {
  std::string plain(trimmed(cell));
  if (std::count(plain.begin(), plain.end(), decimal) > 1) return false;
  std::replace(plain.begin(), plain.end(), decimal, '.');
  return parse_number(plain).has_value();
}

}  // namespace

TableColumn column_of_title(std::string_view written) {
  const std::string narrow = narrow_letters(trimmed(written));
  const std::string_view title = trimmed(narrow);
  TableColumn column{.name = std::string(title), .title = std::string(trimmed(written))};
  const auto split = [&](std::size_t name_end, std::string_view unit) {
    std::string_view name = trimmed(title.substr(0, name_end));
    if (name.ends_with(" /")) name = trimmed(name.substr(0, name.size() - 2));  // "v / (km/h)"
    column.name = name;
    column.unit = trimmed(unit);
  };
  if (title.ends_with(']')) {
    const auto bracket = title.rfind('[');
    if (bracket != title.npos)
      split(bracket, title.substr(bracket + 1, title.size() - bracket - 2));
    return column;
  }
  if (title.ends_with(')')) {
    // A unit such as "bar(g)" itself contains brackets.
    const auto bracket = title.find('(');
    const auto inside = title.substr(bracket + 1, title.size() - bracket - 2);
    if (bracket > 0 && bracket != title.npos &&
        is_unit_in_round_brackets(trimmed(inside), title.substr(0, bracket)))
      split(bracket, inside);
    return column;
  }
  const auto slash = title.rfind(" / ");
  if (slash == title.npos || slash == 0) return column;
  const auto unit = Unit::find(title.substr(slash + 3));
  if (unit && !unit->dimensionless()) split(slash, title.substr(slash + 3));
  return column;
}

std::string fault_of_unit(const TableColumn& column, const std::string& expected) {
  if (expected.empty()) {
    const UnitReading reading = reading_of_unit(column.unit);
    return reading.unit ? "" : called_column(column) + " has " + reading.fault;
  }
  const Unit wanted = Unit::of(expected);
  const UnitReading reading = reading_of_unit(column.unit, wanted);
  if (!reading.unit) return called_column(column) + " has " + reading.fault;
  if (reading.unit->same_dimension(wanted)) return "";
  return called_column(column) +
         (column.unit.empty() ? " has no unit" : " is in " + in_quotes(column.unit)) +
         ", expected " + words_for(wanted).noun + ", such as " +
         unit_in_file(column, unit_to_propose(column.unit, expected)) +
         (wanted.same_dimension(Unit::of("rad")) && !column.unit.empty()
              ? about_unit_of_angle(column, *reading.unit)
              : "");
}

std::string unit_in_file(const TableColumn& column, const std::string& unit) {
  switch (column.unit_place) {
    case UnitPlace::title:
      break;
    case UnitPlace::title_without_blanks: {
      std::string joined = unit;  // "N.m" for "N m"
      std::replace(joined.begin(), joined.end(), ' ', '.');
      return in_quotes(column.name + "[" + joined + "]");
    }
    case UnitPlace::row_below:
      return fmt::format(
          "{} below {} in line {}", in_quotes(unit), in_quotes(column.name), column.unit_line);
    case UnitPlace::field:
      return fmt::format("{} in the field of the unit", in_quotes(unit));
    case UnitPlace::text_beside:
      return fmt::format("a struct {0} with {0}.data and {0}.unit = '{1}'", column.name, unit);
  }
  return in_quotes(column.name + " [" + unit + "]");
}

void take_minus_of_name(TableColumn& column) {
  for (const std::string_view minus : {"-", "\u2212", "\u2013"}) {
    if (!column.name.starts_with(minus)) continue;
    const std::string_view rest = trimmed(std::string_view(column.name).substr(minus.size()));
    const char first = rest.empty() ? '\0' : rest.front();
    const bool is_letter = (first >= 'A' && first <= 'Z') || (first >= 'a' && first <= 'z') ||
                           static_cast<unsigned char>(first) >= 0x80;
    if (!is_letter || rest.starts_with("\u2212") || rest.starts_with("\u2013")) return;
    column.name = std::string(rest);
    column.is_negative = true;
    return;
  }
}

void take_unit_of_name(TableColumn& column, const std::string& expected) {
  if (!column.unit.empty() || expected.empty() || expected == "1") return;
  const auto mark = column.name.rfind('_');
  if (mark == column.name.npos || mark == 0) return;
  const std::string last = column.name.substr(mark + 1);
  const Unit wanted = Unit::of(expected);
  const auto unit = find_unit(last, wanted);
  if (!unit || last == "1" || !unit->same_dimension(wanted)) return;
  column.unit = last;
  column.assumed = "the unit " + in_quotes(last) + " is that of the name";
}

Unit unit_of_column(TableColumn& column, const std::string& expected, const Place& place) {
  const std::string fault = fault_of_unit(column, expected);
  if (!fault.empty()) throw InputError(place, fault);
  if (!expected.empty()) return *reading_of_unit(column.unit, Unit::of(expected)).unit;
  const UnitReading reading = reading_of_unit(column.unit);
  column.assumed = reading.assumed;
  return *reading.unit;
}

void take_stated_unit(TableColumn& column, const std::string& stated, const Place& place) {
  if (stated.empty() || stated == column.unit) return;
  if (column.unit.empty()) {
    column.unit = stated;
    return;
  }
  // If a file has the unit "lb", the statement "lbf" agrees with it, and so does "lbm".
  const auto said = Unit::find(stated);
  const auto written = said ? find_unit(column.unit, *said) : std::nullopt;
  if (!written || !written->same_dimension(*said) || written->to_si(1.0L) != said->to_si(1.0L) ||
      written->to_si(0.0L) != said->to_si(0.0L))
    throw InputError(place,
                     column.name + " is in " + in_quotes(column.unit) + ", but was said to be in " +
                         in_quotes(stated));
  column.unit = stated;
}

std::string missing_columns(const std::vector<std::string>& missing,
                            const std::vector<std::string>& names) {
  std::vector<std::string> some(names.begin(),
                                names.begin() + std::min<long>(kMostNamed, std::ssize(names)));
  std::string listed = list_of(some);
  if (some.size() < names.size()) listed += fmt::format(" and {} more", names.size() - some.size());
  // The most similar name is searched only if the file has few names, because the search is slow.
  const bool few = names.size() <= kMostCompared;
  if (missing.size() == 1)
    return "column " + in_quotes(missing[0]) + " is missing" +
           (few ? did_you_mean(missing[0], names) : "") + " (columns: " + listed + ")";
  std::string text, meant;
  for (const std::string& name : missing) {
    text += (text.empty() ? "" : ", ") + in_quotes(name);
    const auto like = few ? nearest(name, names) : std::nullopt;
    if (like) meant += (meant.empty() ? "" : ", ") + in_quotes(*like) + " for " + in_quotes(name);
  }
  return "columns " + text + " are missing" +
         (meant.empty() ? "" : ", did you mean " + meant + "?") + " (columns: " + listed + ")";
}

std::string reason_of_no_number(std::string_view cell, std::string_view kind_of_file) {
  cell = trimmed(cell);
  if (parse_number(cell)) return ", expected a finite number";  // the cell is NaN or infinite
  if (is_number_with(cell, ','))
    return fmt::format(
        ", a decimal comma, which is not read in {}: write a decimal point, or a .csv with "
        "semicolons or tabs between the columns",
        kind_of_file);
  for (const char* minus : {"\u2212", "\u2013", "\u2010", "\u2011"})
    if (cell.find(minus) != cell.npos)
      return ", a typographic minus, expected the hyphen of the keyboard (-)";
  std::string digits;
  for (const char c : cell)
    if (c != ',' && c != '.' && c != '\'' && c != ' ') digits += c;
  if (parse_number(digits)) return ", expected a number without thousands separators";
  if (cell.find_first_not_of('#') == cell.npos)
    return ", which a spreadsheet writes where a column is too narrow: widen it and save again";
  if (cell.starts_with('(')) return ", expected a number: a negative one begins with a minus";
  if (const std::string unit = unit_in_cell(cell); !unit.empty())
    return fmt::format(
        ", a number with a unit: write [{}] behind the name of the column, and numbers alone below "
        "it",
        unit);
  if (!cell.empty() && cell.find_first_of("0123456789") == cell.npos)
    return ", a text among numbers, expected a finite number: cut off lines that are no samples";
  return ", expected a finite number";
}

bool is_gap_word(std::string_view cell) {
  static constexpr std::array<std::string_view, 21> kWords = {
      "n.a.", "#nv",  "1.#qnan", "-1.#ind", "1.#ind", "-1.#qnan", "",
      "nan",  "-nan", "n/a",     "na",      "#n/a",   "null",     "none",
      "-",    "--",   "---",     "?",       "*",      "notavail", "missing"};
  const std::string word = lower(trimmed(cell));
  return std::find(kWords.begin(), kWords.end(), word) != kWords.end();
}

void DecimalMarks::take(std::string_view number, int line) {
  const std::size_t at = number.find_first_of(",.");
  if (at == number.npos) return;
  const bool comma = number[at] == ',';
  int& mine = comma ? comma_line_ : point_line_;
  if (mine == 0) mine = line;
  if (is_group(number, at)) (comma ? has_comma_group_ : has_point_group_) = true;
  const bool is_mixed = comma_line_ > 0 && point_line_ > 0;
  if (is_mixed && (has_comma_group_ || has_point_group_))
    throw InputError(
        {file_, line},
        fmt::format("has the number {}, and line {} one with a {}: is one of them a separator of "
                    "thousands? Write all numbers with the same mark and without separators",
                    in_quotes(number),
                    comma ? point_line_ : comma_line_,
                    comma ? "point" : "comma"));
}

}  // namespace latsch::formats
