// SPDX-License-Identifier: Apache-2.0
#include "cli/templates/study_reference.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "base/units.h"

namespace latsch::cli {
namespace {

using experiment::KeyForm;
using experiment::KeySection;
using experiment::KeyTable;
using experiment::TabledKey;
using Kind = DeclaredKey::Kind;

constexpr const char* kReferenceHead = R"(# What may stand in a study

`latsch help study` prints this page from the readers of a study, and `latsch help study --json` the same
for programs. A study is a TOML file. Quantities are texts with their unit, such as `"2.6 bar"`; any
unit of the dimension will do. A key that is not known ends in an error that names its line. `latsch
new` writes a study to start from, `latsch check` says what it understood.
)";

bool is_number(Kind kind) {
  return kind == Kind::quantity || kind == Kind::quantities || kind == Kind::one_or_more;
}

/// Returns "a length such as `"25 mm"`".
std::string quantity_words(const std::string& unit) {
  if (unit == "1") return "a plain number";
  const DimensionWords words = words_for(Unit::of(unit));
  return words.noun + " such as `\"" + words.example + "\"`";
}

/// Returns ", above 0 m, at most 1 m".
std::string range_words(const Range& range, const std::string& unit) {
  const std::string in = unit == "1" ? "" : " " + unit;
  const bool from = std::isfinite(range.lower), to = std::isfinite(range.upper);
  if (from && to && !range.lower_excluded)
    return fmt::format(", {:.6g} to {:.6g}{}", range.lower, range.upper, in);
  std::string text;
  if (from)
    text += range.lower_excluded ? fmt::format(", above {:.6g}", range.lower)
            : range.lower == 0.0 ? ", 0 or more"
                                 : fmt::format(", at least {:.6g}{}", range.lower, in);
  if (to) text += fmt::format(", at most {:.6g}{}", range.upper, in);
  return text;
}

std::string choice_words(const std::vector<std::string>& choices) {
  std::vector<std::string> quoted;
  for (const std::string& choice : choices) quoted.push_back("`\"" + choice + "\"`");
  return fmt::format("{}", fmt::join(quoted, ", "));
}

std::string number_words(const KeyForm& form, bool has_one_unit, const std::string& range) {
  const std::string lists = form.kind == Kind::quantities    ? "a list, each "
                            : form.kind == Kind::one_or_more ? "one or a list, each "
                                                             : "";
  const std::string unit = form.units.empty() ? "1" : form.units.front();
  if (!has_one_unit)
    return lists + "a quantity in the unit of the number it belongs to" +
           (range.empty() && form.range.lower_excluded ? ", above 0" : range);
  return lists + quantity_words(unit) + (range.empty() ? range_words(form.range, unit) : range);
}

std::string form_words(const KeyForm& form, bool has_one_unit, const std::string& range) {
  switch (form.kind) {
    case Kind::presence:
      return "";
    case Kind::table:
      return "a table";
    case Kind::tables:
      return "tables with names";
    case Kind::quantity:
    case Kind::quantities:
    case Kind::one_or_more:
      return number_words(form, has_one_unit, range);
    case Kind::rows: {
      std::vector<std::string> columns;
      for (const std::string& unit : form.units) columns.push_back(quantity_words(unit));
      return fmt::format("a list of rows of {}", fmt::join(columns, ", "));
    }
    case Kind::integer:
      return "an integer" +
             (range.empty()
                  ? fmt::format(" from {:.0f} to {:.0f}", form.range.lower, form.range.upper)
                  : range);
    case Kind::flag:
      return "`true` or `false`";
    case Kind::text:
      return "a text in quotes";
    case Kind::choice:
      return range.empty() ? choice_words(form.choices) : range.substr(2);
    case Kind::texts:
      return "a list of texts in quotes";
  }
  return "";
}

/// True if all forms of a key that are numbers have the same unit.
bool has_one_unit(const TabledKey& key) {
  std::vector<std::string> units;
  for (const KeyForm& form : key.forms)
    if (is_number(form.kind) && !form.units.empty()) units.push_back(form.units.front());
  return std::adjacent_find(units.begin(), units.end(), std::not_equal_to<>()) == units.end();
}

std::string expected_words(const TabledKey& key) {
  std::vector<std::string> ways;
  const auto add = [&](const std::string& way) {
    if (!way.empty() && std::find(ways.begin(), ways.end(), way) == ways.end()) ways.push_back(way);
  };
  const std::string range = key.words.range.empty() ? "" : ", " + key.words.range;
  for (const KeyForm& form : key.forms) {
    // A key that may be a measured value: the description already mentions the table {from = ...}.
    if (form.kind == Kind::table && key.is_measurable && key.forms.size() > 1) continue;
    for (const std::string& words : form.expected) add(words);
    const bool is_share = is_number(form.kind) && form.units == std::vector<std::string>{"1"};
    if (form.expected.empty() || !(is_share || form.kind == Kind::text || form.kind == Kind::texts))
      add(form_words(form, has_one_unit(key), range));
  }
  return fmt::format("{}", fmt::join(ways, "; or "));
}

std::string default_words(const TabledKey& key) {
  if (!key.words.otherwise.empty()) return key.words.otherwise;
  std::vector<std::string> quoted;
  for (const std::string& value : key.defaults) quoted.push_back("`" + value + "`");
  return fmt::format("{}", fmt::join(quoted, " or "));
}

/// Returns the table rows of a section. Keys with equal descriptions share a row.
std::string rows_of(const std::vector<TabledKey>& keys) {
  // names of the keys and the contents of the other columns, as pairs
  std::vector<std::pair<std::string, std::string>> rows;
  for (const TabledKey& key : keys) {
    const std::string words =
        fmt::format("{} | {} | {}", key.words.sentence, expected_words(key), default_words(key));
    const std::string name = "`" + key.words.path + "`";
    if (!rows.empty() && rows.back().second == words) {
      rows.back().first += ", " + name;
    } else {
      rows.emplace_back(name, words);
    }
  }
  std::string text = "| key | meaning | expected | unless given |\n| --- | --- | --- | --- |\n";
  for (const auto& [names, words] : rows) text += "| " + names + " | " + words + " |\n";
  return text;
}

std::string section_words(const KeySection& section, const std::vector<TabledKey>& keys) {
  std::string text =
      "\n## " + section.heading + "\n\n" + std::string(trimmed(section.about)) + "\n";
  if (!section.samples.empty()) text += "\n```toml\n" + section.samples.front() + "```\n";
  if (!keys.empty()) text += "\n" + rows_of(keys);
  return text;
}

/// Returns the words of a heading, in lower case; letters, digits and underscores make a word.
std::vector<std::string> words_of(const std::string& heading) {
  std::vector<std::string> words(1);
  for (const char c : heading) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_') {
      words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    } else if (!words.back().empty()) {
      words.emplace_back();
    }
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

/// Returns the name of a test or a table in a heading: the first word behind the first bracket or
/// quotation mark. Returns an empty text if there is none.
std::string name_in(const std::string& heading) {
  const std::size_t begin = heading.find_first_of("[\"");
  if (begin == std::string::npos) return "";
  const std::vector<std::string> words = words_of(heading.substr(begin));
  return words.empty() ? "" : words.front();
}

const char* kind_name(Kind kind) {
  switch (kind) {
    case Kind::presence:
      return "any";
    case Kind::table:
      return "table";
    case Kind::tables:
      return "tables";
    case Kind::quantity:
      return "quantity";
    case Kind::quantities:
      return "list of quantities";
    case Kind::one_or_more:
      return "quantity or list of quantities";
    case Kind::rows:
      return "list of rows";
    case Kind::integer:
      return "integer";
    case Kind::flag:
      return "flag";
    case Kind::text:
      return "text";
    case Kind::choice:
      return "choice";
    case Kind::texts:
      return "list of texts";
  }
  return "";
}

Json form_json(const KeyForm& form) {
  Json json = {{"kind", kind_name(form.kind)}};
  if (!form.units.empty()) json["units"] = form.units;
  if (std::isfinite(form.range.lower)) {
    json["lower"] = form.range.lower;
    json["lower_excluded"] = form.range.lower_excluded;
  }
  if (std::isfinite(form.range.upper)) json["upper"] = form.range.upper;
  if (!form.choices.empty()) json["choices"] = form.choices;
  if (!form.expected.empty()) json["expected"] = form.expected;
  return json;
}

Json key_json(const TabledKey& key) {
  Json json = {{"path", key.words.path},
               {"sentence", key.words.sentence},
               {"required", key.is_required},
               {"measurable", key.is_measurable},
               {"forms", Json::array()}};
  for (const KeyForm& form : key.forms) {
    json["forms"].push_back(form_json(form));
    // the choices in the form are those of a sample, so the description of the range replaces them
    if (!key.words.range.empty()) json["forms"].back().erase("choices");
  }
  if (!key.words.range.empty()) json["range"] = key.words.range;
  if (!key.words.otherwise.empty()) {
    json["default_in_words"] = key.words.otherwise;
  } else if (!key.defaults.empty()) {
    json["defaults"] = key.defaults;
  }
  return json;
}

}  // namespace

std::string words_of(const KeyForm& form) { return form_words(form, /*has_one_unit=*/true, ""); }

std::string study_reference(const KeyTable& keys) {
  std::string text = kReferenceHead;
  for (const auto& [section, of_section] : keys.sections())
    text += section_words(*section, of_section);
  return text;
}

std::string study_reference_on(const KeyTable& keys, const std::string& word) {
  const std::vector<std::string> names = study_reference_words(keys);
  const bool is_name = std::find(names.begin(), names.end(), word) != names.end();
  std::string text;
  for (const auto& [section, of_section] : keys.sections()) {
    const std::vector<std::string> words =
        is_name ? std::vector<std::string>{name_in(section->heading)} : words_of(section->heading);
    if (std::find(words.begin(), words.end(), word) != words.end())
      text += section_words(*section, of_section);
  }
  return text.empty() ? text : text.substr(1);
}

std::vector<std::string> study_reference_words(const KeyTable& keys) {
  std::vector<std::string> names;
  for (const auto& [section, of_section] : keys.sections()) {
    const std::string name = name_in(section->heading);
    if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(name);
  }
  return names;
}

Json study_keys_json(const KeyTable& keys) {
  Json sections = Json::array();
  for (const auto& [section, of_section] : keys.sections()) {
    Json json = {{"heading", section->heading},
                 {"table", section->below},
                 {"about", std::string(trimmed(section->about))},
                 {"samples", section->samples},
                 {"keys", Json::array()}};
    for (const TabledKey& key : of_section) json["keys"].push_back(key_json(key));
    sections.push_back(std::move(json));
  }
  return sections;
}

}  // namespace latsch::cli
