// SPDX-License-Identifier: Apache-2.0
#include "formats/recorders/uff_numbers.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <optional>

#include "base/text.h"

namespace latsch::formats {
namespace {

constexpr std::size_t kSingle = 13, kDouble = 20;  // characters of E13.5 and E20.12

/// Reads a number of Fortran: with E, D or, if the exponent has three digits, no letter before the
/// exponent.
std::optional<double> fortran_field(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && end == text.data() + text.size()) return value;
  std::string plain(text);
  const std::size_t mark = plain.find_first_of("dD");
  const std::size_t sign = plain.find_last_of("+-");
  if (mark != plain.npos) {
    plain[mark] = 'e';
  } else if (sign != plain.npos && sign > 0 && plain.find_first_of("eE") == plain.npos) {
    plain.insert(sign, "e");
  } else {
    return std::nullopt;
  }
  return parse_number(plain);
}

template <class Number>
double uff_number_at(const char* at, bool swapped) {
  char copy[sizeof(Number)];
  std::memcpy(copy, at, sizeof(Number));
  if (swapped) std::reverse(copy, copy + sizeof(Number));
  Number number;
  std::memcpy(&number, copy, sizeof(Number));
  return static_cast<double>(number);
}

}  // namespace

std::vector<std::size_t> UffLayout::widths() const {
  if (!is_double) return std::vector<std::size_t>(6, kSingle);
  if (is_even) return std::vector<std::size_t>(4, kDouble);
  if (is_complex) return {kSingle, kDouble, kDouble};
  return {kSingle, kDouble, kSingle, kDouble};
}

bool take_uff_line(std::string_view line,
                   const std::vector<std::size_t>& widths,
                   std::size_t most,
                   std::vector<double>& numbers) {
  while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.remove_suffix(1);
  const std::size_t count = std::min(widths.size(), most), before = numbers.size();
  // Words between blanks, as many as the line should have, are the usual case.
  std::string_view rest = line;
  for (std::size_t i = 0; i < count; ++i) {
    rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
    const std::string_view word = rest.substr(0, rest.find_first_of(" \t"));
    const auto number = word.empty() ? std::nullopt : fortran_field(word);
    if (!number) break;
    numbers.push_back(*number);
    rest.remove_prefix(word.size());
  }
  if (numbers.size() == before + count && trimmed(rest).empty()) return true;
  // Numbers that touch have only their columns to tell them apart.
  numbers.resize(before);
  rest = line;
  for (std::size_t i = 0; i < count; ++i) {
    const auto number = fortran_field(trimmed(rest.substr(0, widths[i])));
    if (!number) {
      numbers.resize(before);
      return false;
    }
    numbers.push_back(*number);
    rest.remove_prefix(std::min(widths[i], rest.size()));
  }
  if (trimmed(rest).empty()) return true;
  numbers.resize(before);
  return false;
}

std::size_t uff_sample_bytes(const UffLayout& layout, bool has_short_abscissa) {
  const std::size_t all = layout.per_sample() * (layout.is_double ? 8 : 4);
  return layout.is_double && !layout.is_even && has_short_abscissa ? all - 4 : all;
}

std::vector<double> uff_binary(std::string_view bytes,
                               const UffLayout& layout,
                               std::size_t samples,
                               bool is_big_endian,
                               bool has_short_abscissa) {
  const bool swapped = is_big_endian == (std::endian::native == std::endian::little);
  const std::size_t per = layout.per_sample();
  std::vector<double> numbers;
  numbers.reserve(samples * per);
  const char* at = bytes.data();
  for (std::size_t i = 0; i < samples * per; ++i) {
    const bool is_short =
        !layout.is_double || (has_short_abscissa && !layout.is_even && i % per == 0);
    numbers.push_back(is_short ? uff_number_at<float>(at, swapped)
                               : uff_number_at<double>(at, swapped));
    at += is_short ? 4 : 8;
  }
  return numbers;
}

}  // namespace latsch::formats
