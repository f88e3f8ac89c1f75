// SPDX-License-Identifier: Apache-2.0
#include "base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace latsch {
namespace {

// Longer words are taken for data, not for misspelled names.
constexpr std::size_t kLongestName = 64;
constexpr std::size_t kLongestQuotation = 80;

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
  // Optimal string alignment: these are rows i-2, i-1 and i of the table of distances between
  // prefixes.
  std::vector<int> before(b.size() + 1), previous(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) previous[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int substitution = previous[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({previous[j] + 1, row[j - 1] + 1, substitution});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, previous);
    std::swap(previous, row);
  }
  return previous[b.size()];
}

std::optional<std::string> nearest(std::string_view name,
                                   const std::vector<std::string>& candidates) {
  if (name.size() > kLongestName) return std::nullopt;
  const std::string wanted = lower_case(name);
  std::optional<std::string> best;
  int least = 0;
  for (const std::string& candidate : candidates) {
    if (candidate.size() > kLongestName) continue;
    const std::size_t longer = std::max(name.size(), candidate.size());
    // A name of one letter must match exactly; of a longer one, at most half may be wrong.
    const std::size_t shorter = std::min(name.size(), candidate.size());
    const std::size_t most = std::min((longer + 2) / 3, std::max<std::size_t>(shorter / 2, 1));
    const int tolerated = longer < 2 ? 0 : static_cast<int>(most);
    // The distance is at least the difference of the lengths.
    if (static_cast<int>(longer - shorter) > tolerated) continue;
    const int distance = edit_distance(wanted, lower_case(candidate));
    if (distance <= tolerated && (!best || distance < least)) {
      best = candidate;
      least = distance;
    }
  }
  return best;
}

std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates) {
  const std::optional<std::string> best = nearest(name, candidates);
  return best ? ", did you mean " + in_quotes(*best) + "?" : "";
}

std::string in_quotes(std::string_view text) {
  std::string result = "\"";
  for (const char c : text.substr(0, kLongestQuotation)) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      result += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    else
      result += c;
  }
  if (text.size() > kLongestQuotation) {
    // The text must not end within a UTF-8 character.
    while (!result.empty() && (static_cast<unsigned char>(result.back()) & 0x80)) result.pop_back();
    result += "...";
  }
  return result + "\"";
}

std::string list_of(const std::vector<std::string>& words) {
  std::string result;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) result += i + 1 == words.size() ? " or " : ", ";
    result += in_quotes(words[i]);
  }
  return result;
}

std::string counted(std::size_t count, const std::string& word) {
  return std::to_string(count) + " " + word + (count == 1 ? "" : "s");
}

std::string format_number(double value) { return fmt::format("{}", value); }

std::string format_number(double value, int digits) {
  return fmt::format("{:.{}g}", value, digits);
}

std::string format_known(double value, double uncertainty) {
  constexpr int kMostDigits = 9;
  const auto magnitude = [](double x) { return std::floor(std::log10(std::abs(x))); };
  const double digits = magnitude(value) - magnitude(uncertainty) + 2.0;  // -inf if the value is 0
  const double known = std::isnan(digits) ? 1.0 : std::clamp(digits, 1.0, 1.0 * kMostDigits);
  // The value is rounded first: 1987 known to 300 is 1990, not 1.99e+03.
  const std::string rounded = fmt::format("{:.{}e}", value, static_cast<int>(known) - 1);
  return format_number(parse_number(rounded).value_or(value), kMostDigits);
}

std::optional<double> parse_number(std::string_view text) {
  text = trimmed(text);
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

}  // namespace latsch
