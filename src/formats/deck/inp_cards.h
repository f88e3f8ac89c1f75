// SPDX-License-Identifier: Apache-2.0
// Splits the text of an .inp file (CalculiX, Abaqus) into cards: keyword lines with options,
// followed by data lines of fields.
//
//   *ELEMENT, TYPE=C3D8, ELSET=TIRE      keyword, options
//   1, 1, 91, 94, 4, ...                 data
//   ** a comment
//
// Keywords, options and set names do not distinguish upper and lower case and are returned in
// capitals.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace latsch::formats {

/// A data line: its number in the file, and its fields without blanks at their ends.
struct InpLine {
  int number = 0;
  std::vector<std::string> fields;
};

/// A keyword and the data lines below it.
struct InpCard {
  std::string keyword;                         // "SOLID SECTION"
  std::map<std::string, std::string> options;  // "ELSET" -> "TIRE"; an option without value -> ""
  std::vector<InpLine> lines;
  Place place;

  bool has(const std::string& option) const { return options.count(option) > 0; }
  /// Return the text of an option. Without `fallback`, throws InputError if the option is missing.
  const std::string& option(const std::string& name) const;
  std::string option(const std::string& name, const std::string& fallback) const;

  Place at(const InpLine& line) const { return {place.file, line.number}; }
  /// Return field `index` of a line as a finite number or an integer. Throw InputError that names
  /// the line if the field is neither; a missing field has the value `fallback`, if one is given.
  double number(const InpLine& line, std::size_t index) const;
  double number(const InpLine& line, std::size_t index, double fallback) const;
  int integer(const InpLine& line, std::size_t index) const;
  const std::string& text(const InpLine& line, std::size_t index) const;
  /// Returns all numbers of all lines one after the other.
  std::vector<double> numbers() const;
};

/// Returns the cards of the text. Throws InputError for data before the first keyword, for a line
/// longer than 4,096 characters, and for bytes that are not text.
std::vector<InpCard> split_cards(std::string_view text, const std::string& file_name);

}  // namespace latsch::formats
