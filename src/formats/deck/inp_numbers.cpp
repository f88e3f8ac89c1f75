// SPDX-License-Identifier: Apache-2.0
// Determines the units of the numbers of a deck, and writes numbers back into their fields.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>

#include "formats/deck/inp_deck.h"

namespace latsch::formats {
namespace {

constexpr std::size_t kLongestField = 20;  // characters; CalculiX reads no longer field

/// Returns the number with as many digits as are needed to read it back exactly, as far as the
/// field has room.
std::string field_text(double value) {
  std::string text = fmt::format("{}", value);
  for (int digits = 16; text.size() > kLongestField; --digits)
    text = fmt::format("{:.{}g}", value, digits);
  return text;
}

/// Returns a data line in which the given fields have other numbers; blanks around the fields stay.
std::string with_fields(std::string_view line, const std::map<std::size_t, double>& changes) {
  std::string result;
  std::size_t field = 0;
  while (true) {
    const std::size_t comma = std::min(line.find_first_of(",\n", 0), line.size());
    const std::string_view one = line.substr(0, comma);
    const auto change = changes.find(field++);
    if (change == changes.end()) {
      result += one;
    } else {
      const std::size_t first = one.find_first_not_of(" \t\r"),
                        last = one.find_last_not_of(" \t\r");
      result += one.substr(0, first);
      result += field_text(change->second);
      result += one.substr(last + 1);
    }
    if (comma == line.size()) return result;
    result += line[comma];
    line.remove_prefix(comma + 1);
  }
}

}  // namespace

InpUnits units_by_size(const InpDeck& deck) {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero(), axis = Eigen::Vector3d::UnitZ();
  for (const auto& [name, orientation] : deck.orientations)
    if (orientation.cylindrical) {
      origin = orientation.a;
      axis = (orientation.b - orientation.a).normalized();
      break;
    }
  double radius = 0.0;
  for (const auto& [number, x] : deck.nodes)
    radius = std::max(radius, (x - origin).cross(axis).norm());
  return units_of_size(radius).value_or(InpUnits{});
}

std::string with_numbers_of(const InpDeck& deck, std::string_view text) {
  const InpDeck before = parse_inp(text, deck.file);
  std::map<int, std::map<std::size_t, double>> changes;  // new numbers by line, then by field
  for (std::size_t i = 0; i < before.numbers.size(); ++i) {
    const double value = deck.numbers.at(i).value;
    if (value == before.numbers[i].value) continue;
    for (const InpNumber::Where& where : before.numbers[i].where)
      changes[where.line][where.field] = value * where.times;
  }
  std::string result;
  int line = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
    const auto changed = changes.find(++line);
    if (changed == changes.end())
      result.append(text.substr(begin, end - begin));
    else
      result += with_fields(text.substr(begin, end - begin), changed->second);
    begin = end;
  }
  return result;
}

}  // namespace latsch::formats
