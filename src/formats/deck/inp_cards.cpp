// SPDX-License-Identifier: Apache-2.0
#include "formats/deck/inp_cards.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "base/utf8.h"
#include "formats/text/letter_case.h"

namespace latsch::formats {
namespace {

constexpr std::size_t kLongestCard = 4096;

std::string_view strip(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

std::vector<std::string> split(std::string_view line) {
  std::vector<std::string> fields;
  while (true) {
    const auto comma = line.find(',');
    fields.push_back(capitals(strip(line.substr(0, comma))));
    if (comma == std::string_view::npos) break;
    line.remove_prefix(comma + 1);
  }
  while (!fields.empty() && fields.back().empty()) fields.pop_back();
  return fields;
}

InpCard read_keyword(std::string_view line, Place place) {
  InpCard card;
  card.place = std::move(place);
  const std::vector<std::string> fields = split(line.substr(1));
  if (fields.empty() || fields[0].empty())
    throw InputError(card.place, "a lone \"*\", expected a keyword such as *NODE");
  card.keyword = fields[0];
  for (std::size_t i = 1; i < fields.size(); ++i) {
    const auto equals = fields[i].find('=');
    const std::string name(strip(std::string_view(fields[i]).substr(0, equals)));
    const std::string value =
        equals == std::string::npos
            ? ""
            : std::string(strip(std::string_view(fields[i]).substr(equals + 1)));
    card.options[name] = value;
  }
  return card;
}

template <class Number>
std::optional<Number> parse(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

}  // namespace

const std::string& InpCard::option(const std::string& name) const {
  const auto found = options.find(name);
  if (found == options.end() || found->second.empty())
    throw InputError(place, fmt::format("*{} has no {}=, expected one", keyword, name));
  return found->second;
}

std::string InpCard::option(const std::string& name, const std::string& fallback) const {
  const auto found = options.find(name);
  return found == options.end() ? fallback : found->second;
}

const std::string& InpCard::text(const InpLine& line, std::size_t index) const {
  if (index >= line.fields.size() || line.fields[index].empty())
    throw InputError(
        at(line),
        fmt::format("*{} misses its field {}, expected a value there: is the file whole?",
                    keyword,
                    index + 1));
  return line.fields[index];
}

double InpCard::number(const InpLine& line, std::size_t index) const {
  const auto value = parse<double>(text(line, index));
  if (!value || !std::isfinite(*value))
    throw InputError(at(line),
                     fmt::format("\"{}\" in field {} of *{}, expected a number",
                                 line.fields[index].substr(0, 40),
                                 index + 1,
                                 keyword));
  return *value;
}

double InpCard::number(const InpLine& line, std::size_t index, double fallback) const {
  if (index >= line.fields.size() || line.fields[index].empty()) return fallback;
  return number(line, index);
}

int InpCard::integer(const InpLine& line, std::size_t index) const {
  const auto value = parse<int>(text(line, index));
  if (!value)
    throw InputError(at(line),
                     fmt::format("\"{}\" in field {} of *{}, expected an integer",
                                 line.fields[index].substr(0, 40),
                                 index + 1,
                                 keyword));
  return *value;
}

std::vector<double> InpCard::numbers() const {
  std::vector<double> values;
  for (const InpLine& line : lines)
    for (std::size_t i = 0; i < line.fields.size(); ++i) values.push_back(number(line, i));
  return values;
}

std::vector<InpCard> split_cards(std::string_view text, const std::string& file_name) {
  refuse_utf16(text, file_name);
  std::vector<InpCard> cards;
  int number = 0;
  while (!text.empty()) {
    ++number;
    const auto end = text.find('\n');
    const std::string_view line = strip(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    const Place place{file_name, number};
    if (line.size() > kLongestCard)
      throw InputError(
          place,
          fmt::format("a line of {} characters, expected at most {}", line.size(), kLongestCard));
    if (std::any_of(line.begin(), line.end(), [](unsigned char c) { return c < 32 && c != '\t'; }))
      throw InputError(place, "a control character, expected a text file");
    if (line.empty() || line.starts_with("**")) continue;
    if (line.front() == '*') {
      cards.push_back(read_keyword(line, place));
    } else if (cards.empty()) {
      throw InputError(place, "data before the first keyword, expected a line such as *NODE");
    } else {
      cards.back().lines.push_back({number, split(line)});
    }
  }
  return cards;
}

}  // namespace latsch::formats
