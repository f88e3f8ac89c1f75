// SPDX-License-Identifier: Apache-2.0
// Parses numbers as Fortran prints them: the exponent of a double follows the letter D, "1.2D+03".
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/text.h"

namespace latsch::formats {

/// Reads a number whose exponent follows a D; nothing for any other text.
inline std::optional<double> parse_fortran_number(std::string_view text) {
  const std::size_t letter = text.find_first_of("Dd");
  if (letter == text.npos || letter == 0 || letter + 1 == text.size()) return std::nullopt;
  const char before = text[letter - 1];
  if (!((before >= '0' && before <= '9') || before == '.')) return std::nullopt;
  std::string with_e(text);
  with_e[letter] = 'e';
  return parse_number(with_e);
}

}  // namespace latsch::formats
