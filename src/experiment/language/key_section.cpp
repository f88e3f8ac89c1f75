// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "base/error.h"
#include "base/text.h"

namespace latsch::experiment {
namespace {

using Kind = DeclaredKey::Kind;

/// Splits "a.b.c" into "a" and "b.c".
std::pair<std::string, std::string> split_path(const std::string& path) {
  const std::size_t dot = path.find('.');
  if (dot == path.npos) return {path, ""};
  return {path.substr(0, dot), path.substr(dot + 1)};
}

/// Returns the part of a path below a table; nothing if the path does not lead into the table.
std::optional<std::string> below(std::string path, std::string table) {
  while (!table.empty()) {
    if (path.empty()) return std::nullopt;
    const auto [first, rest] = split_path(path);
    const auto [pattern, others] = split_path(table);
    if (pattern != "*" && pattern != first) return std::nullopt;
    path = rest;
    table = others;
  }
  return path.empty() ? std::nullopt : std::optional(path);
}

std::vector<std::string> paths_of(const std::string& joined) {
  std::vector<std::string> paths;
  std::size_t from = 0;
  for (std::size_t at = joined.find(", "); at != joined.npos; at = joined.find(", ", from)) {
    paths.push_back(joined.substr(from, at - from));
    from = at + 2;
  }
  paths.push_back(joined.substr(from));
  return paths;
}

struct PlaceOfKey {
  const KeySection* section;
  std::string path;  // below the section's table
};

/// Returns the places in which a key may be described: its own section, then the sections that
/// share their keys with it.
std::vector<PlaceOfKey> places_of(const KeySection& section, const std::string& path) {
  std::vector<PlaceOfKey> places = {{&section, path}};
  for (std::size_t i = 0; i < places.size(); ++i)
    for (const SharedKeys& shared : places[i].section->shared) {
      const auto rest = below(places[i].path, shared.below);
      if (!rest) continue;
      const KeySection* const other = &shared.section();
      const bool is_known = std::any_of(places.begin(), places.end(), [&](const PlaceOfKey& one) {
        return one.section == other && one.path == *rest;
      });
      if (!is_known) places.push_back({other, *rest});
    }
  return places;
}

bool refuses(const KeySection& section, const std::string& path) {
  const auto places = places_of(section, path);
  return std::any_of(places.begin(), places.end(), [](const PlaceOfKey& place) {
    const auto& refused = place.section->refused;
    return std::any_of(refused.begin(), refused.end(), [&](const std::string& one) {
      return matches(place.path, one);
    });
  });
}

bool is_same(const KeyForm& a, const KeyForm& b) {
  return a.kind == b.kind && a.units == b.units && a.range.lower == b.range.lower &&
         a.range.upper == b.range.upper && a.range.lower_excluded == b.range.lower_excluded &&
         a.choices == b.choices && a.expected == b.expected;
}

void merge(const DeclaredKey& declared, TabledKey& key) {
  key.is_requested = true;
  key.is_measurable = key.is_measurable || declared.is_measurable;
  key.is_stated = key.is_stated || declared.is_there;
  key.is_required = key.is_required && !declared.may_be_missing && !declared.fallback;
  if (declared.fallback &&
      std::find(key.defaults.begin(), key.defaults.end(), *declared.fallback) == key.defaults.end())
    key.defaults.push_back(*declared.fallback);
  const KeyForm form{
      declared.kind, declared.units, declared.range, declared.choices, declared.expected};
  const bool is_known = std::any_of(
      key.forms.begin(), key.forms.end(), [&](const KeyForm& one) { return is_same(one, form); });
  if (declared.kind == Kind::presence && !declared.is_there) return;
  if (!is_known) key.forms.push_back(form);
}

}  // namespace

bool matches(const std::string& path, const std::string& pattern) {
  const auto [first, rest] = split_path(path);
  const auto [one, others] = split_path(pattern);
  if (one == "*" && others.empty()) return true;
  if (one != "*" && one != first) return false;
  if (rest.empty() || others.empty()) return rest.empty() && others.empty();
  return matches(rest, others);
}

namespace {

/// Adds the names of the keys that a section describes or refuses at the root of its table; "*" if
/// it accepts any name.
void add_root_keys(const KeySection& section,
                   std::vector<const KeySection*>& seen,
                   std::vector<std::string>& names) {
  if (std::ranges::find(seen, &section) != seen.end()) return;
  seen.push_back(&section);
  const auto add = [&](const std::string& joined) {
    for (const std::string& path : paths_of(joined)) names.push_back(split_path(path).first);
  };
  for (const KeySentence& sentence : section.sentences) add(sentence.path);
  for (const std::string& path : section.refused) add(path);
  for (const SharedKeys& shared : section.shared) {
    if (shared.below.empty()) {
      add_root_keys(shared.section(), seen, names);
    } else {
      names.push_back(split_path(shared.below).first);
    }
  }
}

}  // namespace

namespace {

/// Returns the names in alphabetic order, each once.
std::string listed(std::vector<std::string> names) {
  std::ranges::sort(names);
  const auto again = std::ranges::unique(names);
  names.erase(again.begin(), again.end());
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

void refuse_unknown_keys(const Node& table, const KeySection& section) {
  std::vector<const KeySection*> seen;
  std::vector<std::string> names = {"kind"};
  add_root_keys(section, seen, names);
  if (std::ranges::find(names, "*") != names.end()) return;
  for (const std::string& key : table.keys()) {
    if (std::ranges::find(names, key) != names.end()) continue;
    const std::string path = table.path().empty() ? key : table.path() + "." + key;
    const std::string guess = did_you_mean(key, names);
    throw InputError(table.place(key),
                     "unknown key " + in_quotes(path) +
                         (guess.empty() ? "; the keys here are " + listed(names) : guess));
  }
}

KeyTable::KeyTable(const std::vector<const KeySection*>& sections) {
  for (const KeySection* section : sections) {
    sections_.push_back({section, {}});
    for (const KeySentence& sentence : section->sentences)
      for (std::string& path : paths_of(sentence.path)) {
        TabledKey key;
        key.words = sentence;
        key.words.path = std::move(path);
        sections_.back().keys.push_back(std::move(key));
      }
  }
}

TabledKey* KeyTable::find(const KeySection& section, const std::string& path) {
  for (const PlaceOfKey& place : places_of(section, path))
    for (TabledSection& tabled : sections_) {
      if (tabled.section != place.section) continue;
      for (TabledKey& key : tabled.keys)
        if (matches(place.path, key.words.path)) return &key;
    }
  return nullptr;
}

void KeyTable::add(const KeySection& section, const std::map<std::string, DeclaredKey>& declared) {
  for (const auto& [path, what] : declared) {
    const auto rest = below(path, section.below);
    if (!rest || (section.below.empty() && section.is_top && rest->find('.') != rest->npos))
      continue;
    if (TabledKey* key = find(section, *rest)) {
      merge(what, *key);
      continue;
    }
    if (refuses(section, *rest)) continue;
    Undescribed& key = undescribed_[section.heading + ": `" + *rest + "` "];
    const bool is_value = what.kind != Kind::table && what.kind != Kind::tables;
    key.needs_sentence = key.needs_sentence || (is_value && what.kind != Kind::presence) ||
                         (is_value && what.is_there);
    key.is_stated = key.is_stated || what.is_there;
  }
}

std::vector<std::string> KeyTable::faults() const {
  std::vector<std::string> faults;
  for (const auto& [name, key] : undescribed_) {
    if (key.needs_sentence) faults.push_back(name + "has no sentence");
    if (!key.is_stated) faults.push_back(name + "is stated by no sample");
  }
  for (const auto& [section, keys] : sections_)
    for (const TabledKey& key : keys) {
      const std::string name = section->heading + ": `" + key.words.path + "` ";
      if (!key.is_requested) {
        faults.push_back(name + "has a sentence, but no reader requests it");
      } else if (!key.is_stated) {
        faults.push_back(name + "is stated by no sample");
      }
    }
  return faults;
}

}  // namespace latsch::experiment
