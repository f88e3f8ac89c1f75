// SPDX-License-Identifier: Apache-2.0
#include "evaluation/outside_program/input_template.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <optional>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/text.h"
#include "base/unit_words/c_locale.h"
#include "base/units.h"

namespace latsch {
namespace {

bool is_name_character(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

/// True if `format` reads exactly one number: "%", flags, width and precision, followed by e, f or
/// g.
bool is_number_format(std::string_view format) {
  std::size_t at = 0;
  const auto skip = [&](std::string_view set) {
    const std::size_t from = at;
    while (at < format.size() && set.find(format[at]) != std::string_view::npos) ++at;
    return at - from;
  };
  if (format.empty() || format[at++] != '%') return false;
  skip("-+ 0#");
  if (skip("0123456789") > 2) return false;
  if (skip(".") > 0 && skip("0123456789") > 2) return false;
  return at + 1 == format.size() &&
         std::string_view("eEfFgG").find(format[at]) != std::string_view::npos;
}

struct Hole {
  std::string name;
  std::string format;
  std::size_t size;  // length of {name}, the hole, in the file
};

/// Returns the hole {name} that begins with the brace at `at`; nullopt if no name follows.
std::optional<Hole> hole_at(std::string_view text, std::size_t at) {
  std::size_t end = at + 1;
  while (end < text.size() && is_name_character(text[end])) ++end;
  if (end == at + 1 || end >= text.size()) return std::nullopt;
  if (std::isdigit(static_cast<unsigned char>(text[at + 1]))) return std::nullopt;
  Hole hole{std::string(text.substr(at + 1, end - at - 1)), {}, 0};
  if (text[end] == ':') {
    const std::size_t close = text.find('}', end);
    if (close == std::string_view::npos || close > text.find('\n', end)) return std::nullopt;
    hole.format = text.substr(end + 1, close - end - 1);
    if (!hole.format.starts_with('%')) return std::nullopt;
    end = close;
  }
  if (text[end] != '}') return std::nullopt;
  hole.size = end + 1 - at;
  return hole;
}

/// Returns the length of an escaped hole {{NAME}} at `at`, which stands for the text {NAME}; 0 if
/// there is none.
std::size_t doubled_hole_at(std::string_view text, std::size_t at) {
  if (!text.substr(at).starts_with("{{")) return 0;
  const auto hole = hole_at(text, at + 1);
  if (!hole || !text.substr(at + 1 + hole->size).starts_with('}')) return 0;
  return hole->size + 2;
}

int variable_named(const DesignSpace& space, const Hole& hole, const Place& place) {
  std::vector<std::string> names;
  for (int i = 0; i < space.size(); ++i) {
    if (space[i].name == hole.name) return i;
    names.push_back(space[i].name);
  }
  const std::string meant = did_you_mean(hole.name, names);
  throw InputError(place,
                   "the hole {" + hole.name + "} names no variable of the study" +
                       (meant.empty() ? "." : meant) + " Write {{" + hole.name +
                       "}} if no hole is meant");
}

std::string written(const DesignVariable& variable, double value, const std::string& format) {
  const Unit unit = Unit::of(variable.unit);
  if (format.empty()) return unit.exact_number(value);
  std::array<char, 512> buffer{};
  [[maybe_unused]] const CLocale decimal_points;
  std::snprintf(buffer.data(), buffer.size(), format.c_str(), unit.from_si(value));
  return buffer.data();
}

}  // namespace

InputTemplate::InputTemplate(std::string text, const std::string& file, const DesignSpace& space)
    : text_(std::move(text)) {
  Part part;
  int line = 1;
  for (std::size_t at = 0; at < text_.size();) {
    if (const std::size_t size = doubled_hole_at(text_, at)) {
      part.before += text_.substr(at + 1, size - 2);
      at += size;
      continue;
    }
    const auto hole = text_[at] == '{' ? hole_at(text_, at) : std::nullopt;
    if (hole) {
      const Place place{file, line};
      part.variable = variable_named(space, *hole, place);
      part.format = hole->format;
      if (!part.format.empty() && !is_number_format(part.format)) {
        throw InputError(place,
                         "{" + hole->name + ":" + hole->format +
                             "} has no format of a number, expected one such as {" + hole->name +
                             ":%.6g}");
      }
      parts_.push_back(std::exchange(part, {}));
      at += hole->size;
      continue;
    }
    line += text_[at] == '\n';
    part.before += text_[at];
    ++at;
  }
  parts_.push_back(std::move(part));
}

std::string InputTemplate::filled(const DesignSpace& space, const DesignPoint& point) const {
  std::string text;
  for (const Part& part : parts_) {
    text += part.before;
    if (part.variable < 0) continue;
    text += written(space[part.variable], point.values[part.variable], part.format);
  }
  return text;
}

bool InputTemplate::uses(int variable) const {
  return std::any_of(
      parts_.begin(), parts_.end(), [&](const Part& part) { return part.variable == variable; });
}

}  // namespace latsch
