// SPDX-License-Identifier: Apache-2.0
#include "report/html_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "base/units.h"

namespace latsch::report {
namespace {

constexpr const char* kNothing = "–";

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

}  // namespace

std::string escape(std::string_view text) {
  std::string safe;
  for (char c : text) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      case '\'':
        safe += "&#39;";
        break;
      default:
        if (static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t') safe += c;
    }
  }
  return safe;
}

std::string true_minus(std::string number) {
  if (number.empty() || number[0] != '-') return number;
  number.erase(0, 1);
  return number.find_first_of("123456789") == std::string::npos ? number : "−" + number;
}

std::string fixed(double value, int decimals) {
  if (!std::isfinite(value)) return kNothing;
  return true_minus(fmt::format("{:.{}f}", value, decimals));
}

std::string significant(double value, int digits) {
  if (!std::isfinite(value)) return kNothing;
  if (value == 0.0) return "0";
  const double magnitude = std::abs(value);
  if (magnitude < 1e-4 || magnitude >= 1e6)
    return true_minus(fmt::format("{:.{}g}", value, digits));
  const int before = static_cast<int>(std::floor(std::log10(magnitude))) + 1;
  std::string text = fmt::format("{:.{}f}", value, std::max(0, digits - before));
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return true_minus(text);
}

std::string percent(double ratio, int decimals) {
  if (!std::isfinite(ratio)) return kNothing;
  return fixed(100.0 * ratio, decimals) + " %";
}

std::string small_percent(double ratio) {
  constexpr double kShown = 1e-3;
  if (!(ratio > 0.0 && ratio < kShown)) return percent(ratio);
  return significant(100.0 * ratio, 2) + " %";
}

std::string signed_percent(double ratio, int decimals) {
  return fmt::format("{}{}", ratio > 0.0 ? "+" : "", percent(ratio, decimals));
}

std::string duration(double seconds) {
  if (!std::isfinite(seconds)) return kNothing;
  if (seconds < 10.0 || seconds > 1e8)
    return fmt::format("{} s", seconds < 10.0 ? fixed(seconds, 1) : significant(seconds, 3));
  const long s = std::lround(seconds);
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {:02} s", s / 60, s % 60);
  return fmt::format("{} h {:02} min", s / 3600, s % 3600 / 60);
}

std::string typeset_unit(std::string_view unit) {
  std::string text(unit);
  replace_all(text, "^2", "²");
  replace_all(text, "^3", "³");
  replace_all(text, "deg", "°");
  replace_all(text, "*", "·");
  return text;
}

std::string typeset_words(std::string_view words) {
  std::string text = typeset_unit(words);
  replace_all(text, "+- ", "± ");
  replace_all(text, " .. ", " … ");
  for (std::size_t at = text.find('-'); at != std::string::npos; at = text.find('-', at + 1)) {
    const bool begins = at == 0 || text[at - 1] == ' ' || text[at - 1] == '(';
    if (begins && at + 1 < text.size() && std::isdigit(static_cast<unsigned char>(text[at + 1])))
      text.replace(at, 1, "−");
  }
  return text;
}

std::string unit_suffix(std::string_view unit) {
  return unit.empty() || unit == "1" ? "" : fmt::format(" {}", typeset_unit(unit));
}

double in_unit(double si, std::string_view unit) {
  const auto known = Unit::find(unit);
  return known ? known->from_si(si) : si;
}

}  // namespace latsch::report
