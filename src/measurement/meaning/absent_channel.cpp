// SPDX-License-Identifier: Apache-2.0
#include "measurement/meaning/absent_channel.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>

#include "base/units.h"
#include "measurement/meaning/channel_words.h"

namespace latsch {
namespace {

/// A channel with a meaning of its own that on some rigs replaces a missing channel.
struct Relative {
  std::string_view missing, other, words;
  std::string_view with = {};  // a second channel that is also needed for that
  bool is_as_it_stands = false;
};
constexpr std::array kRelatives = {
    Relative{
        "alpha", "toe", "a toe angle, the slip angle of a wheel that rolls straight on", "", true},
    Relative{"alpha",
             "steer",
             "a steer angle, the slip angle of a wheel that rolls straight on",
             "",
             true},
    Relative{"alpha", "Vy", "with Vx: alpha = atan(Vy / Vx)", "Vx"},
    Relative{"kappa", "SL", "slip of the loaded radius, which is not kappa itself"},
    Relative{"kappa", "omega", "with Vx: kappa = omega R_e / Vx - 1", "Vx"},
};

std::vector<std::string_view> words_of(std::string_view name) {
  constexpr std::string_view kBetween = " _-./()[]{}|*^+=,:;#<>'\"";
  std::vector<std::string_view> words;
  const auto is_small = [](char c) { return c >= 'a' && c <= 'z'; };
  const auto is_capital = [](char c) { return c >= 'A' && c <= 'Z'; };
  while (!name.empty()) {
    const std::size_t begin = std::min(name.find_first_not_of(kBetween), name.size());
    std::size_t end = std::min(name.find_first_of(kBetween, begin), name.size());
    for (std::size_t i = begin + 1; i < end; ++i)  // "AlphaDeg" has two words
      if (is_small(name[i - 1]) && is_capital(name[i])) end = i;
    if (end > begin) words.push_back(name.substr(begin, end - begin));
    name.remove_prefix(end);
  }
  return words;
}

constexpr std::array<std::string_view, 9> kFunctions = {
    "tan", "sin", "cos", "abs", "sqrt", "log", "rate", "std", "var"};

bool same_letters(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) ==
           std::tolower(static_cast<unsigned char>(y));
  });
}

/// Returns the known channel name in a one-word name of a function: "ALPHA" of "TANALPHA"; "" if
/// there is none.
std::string_view argument_of(std::string_view name) {
  for (const std::string_view function : kFunctions)
    if (name.size() > function.size() + 1 &&
        same_letters(name.substr(0, function.size()), function) &&
        recognized(name.substr(function.size())))
      return name.substr(function.size());
  return "";
}

/// Returns the channels named by words within an unknown name: alpha for "tan alpha".
std::vector<std::string_view> channels_within(std::string_view name) {
  constexpr std::size_t kMostWords = 3;
  // least length of such a channel name, because a single letter may match by chance
  constexpr std::size_t kFewestLetters = 2;
  std::vector<std::string_view> found;
  if (const auto argument = argument_of(name); !argument.empty())
    found.push_back(recognized(argument)->meaning->name);
  const auto words = words_of(name);
  for (std::size_t first = 0; first < words.size(); ++first) {
    std::string text;
    for (std::size_t k = first; k < std::min(words.size(), first + kMostWords); ++k) {
      text += (text.empty() ? "" : " ") + std::string(words[k]);
      const auto known = text.size() < kFewestLetters ? std::nullopt : recognized(text);
      if (known) found.push_back(known->meaning->name);
    }
  }
  return found;
}

/// True if the name is that of a function of another quantity, such as "tan alpha".
bool is_function(std::string_view name) {
  if (!argument_of(name).empty()) return true;
  return std::ranges::any_of(words_of(name), [](std::string_view word) {
    return std::ranges::any_of(kFunctions,
                               [&](std::string_view one) { return same_letters(word, one); });
  });
}

std::optional<MayBe> unknown_name(std::string_view channel,
                                  std::string_view unit,
                                  const OtherColumn& column) {
  const auto within = channels_within(column.name);
  const auto names = [&](std::string_view other) {
    return std::find(within.begin(), within.end(), other) != within.end();
  };
  if (channel == "alpha" && names("Vy") && names("Vx"))
    return MayBe{column.name, "Vy over Vx, the tangent of alpha?", false};
  const bool is_within = names(channel);
  if (!within.empty() && !is_within) return std::nullopt;
  const bool fits = !column.has_unit || column.unit.empty() ||
                    Unit::of(column.unit).same_dimension(Unit::of(unit));
  if (is_within && (!fits || is_function(column.name)))
    return MayBe{column.name, "a function of it?", false};
  if (fits) return MayBe{column.name, "", true, is_within};
  if (channel == "alpha" && column.unit == "1" && column.is_slip_like)
    return MayBe{column.name, "a plain number: its tangent?", false};
  return std::nullopt;
}

std::optional<MayBe> known_name(std::string_view channel,
                                const OtherColumn& column,
                                const RecognizedName& known,
                                const std::vector<OtherColumn>& columns) {
  if (known.meaning->name == channel) {
    if (!column.taken_as.empty() && !same_channel(column.taken_as, column.name))
      return MayBe{column.name, "stated to be " + column.taken_as};
    if (column.is_used) return std::nullopt;
    if (column.has_unit && !column.unit.empty() &&
        !Unit::of(column.unit).same_dimension(Unit::of(known.meaning->unit)))
      return MayBe{
          column.name, fmt::format("in {}, expected {}", column.unit, known.meaning->unit), false};
    if (known.channel == channel) return std::nullopt;
    return MayBe{column.name, "that of one wheel or frame", true, true};
  }
  if (column.is_used) return std::nullopt;
  const auto has = [&](std::string_view other) {
    return other.empty() || std::any_of(columns.begin(), columns.end(), [&](const auto& one) {
             const auto name = recognized(one.taken_as.empty() ? one.name : one.taken_as);
             return name && name->meaning->name == other;
           });
  };
  for (const Relative& relative : kRelatives)
    if (relative.missing == channel && relative.other == known.meaning->name && has(relative.with))
      return MayBe{column.name, std::string(relative.words), relative.is_as_it_stands};
  return std::nullopt;
}

}  // namespace

std::vector<MayBe> columns_that_may_be(std::string_view channel,
                                       std::string_view unit,
                                       const std::vector<OtherColumn>& columns) {
  std::vector<MayBe> found, computed;
  for (const OtherColumn& column : columns) {
    const auto known = recognized(column.name);
    const bool is_stated = !column.taken_as.empty() && column.taken_as != column.name;
    if (!known && (column.is_used || is_stated)) continue;
    auto one =
        known ? known_name(channel, column, *known, columns) : unknown_name(channel, unit, column);
    if (one) (one->is_as_it_stands ? found : computed).push_back(std::move(*one));
  }
  std::stable_partition(
      found.begin(), found.end(), [](const MayBe& one) { return one.has_its_name; });
  found.insert(found.end(), computed.begin(), computed.end());
  return found;
}

std::string list_in_words(const std::vector<MayBe>& columns, std::size_t most) {
  std::string text;
  for (std::size_t i = 0; i < std::min(most, columns.size()); ++i) {
    text += (i == 0 ? "`" : ", `") + columns[i].column + "`";
    if (!columns[i].words.empty()) text += " (" + columns[i].words + ")";
  }
  if (columns.size() > most) text += fmt::format(" and {} more", columns.size() - most);
  return text;
}

}  // namespace latsch
