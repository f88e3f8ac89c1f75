// SPDX-License-Identifier: Apache-2.0
#include "correlation/study/settings/selection_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "base/text.h"
#include "base/units.h"

namespace latsch::correlation {
namespace {

constexpr long kMostSelectionRefits = 10'000;

/// True if the name agrees with the pattern, in which * stands for any characters.
bool agrees(std::string_view name, std::string_view pattern) {
  if (pattern.empty()) return name.empty();
  if (pattern.front() != '*')
    return !name.empty() && name.front() == pattern.front() &&
           agrees(name.substr(1), pattern.substr(1));
  for (std::size_t skipped = 0; skipped <= name.size(); ++skipped)
    if (agrees(name.substr(skipped), pattern.substr(1))) return true;
  return false;
}

std::vector<std::string> names_of(const DesignSpace& space) {
  std::vector<std::string> names;
  for (const DesignVariable& variable : space.variables()) names.push_back(variable.name);
  return names;
}

/// Returns the variables that agree with one of the patterns of a list. Throws if one agrees with
/// none.
std::set<int> matching(const Node& table, const std::string& key, const DesignSpace& space) {
  std::set<int> found;
  const std::vector<std::string> patterns = table.texts(key);
  if (patterns.empty()) table.reject(key, "is empty, expected names of variables such as \"PKY*\"");
  for (const std::string& pattern : patterns) {
    const std::size_t before = found.size();
    bool any = false;
    for (int i = 0; i < space.size(); ++i) {
      if (!agrees(space[i].name, pattern)) continue;
      found.insert(i);
      any = true;
    }
    if (!any)
      table.reject(key,
                   "has " + in_quotes(pattern) + ", which is the name of no variable" +
                       did_you_mean(pattern, names_of(space)) + "; there are " +
                       list_of(names_of(space)));
    if (found.size() == before)
      table.reject(key, "has " + in_quotes(pattern) + ", which only repeats names before it");
  }
  return found;
}

void read_toward(const Node& table,
                 const std::set<int>& candidates,
                 const DesignSpace& space,
                 std::vector<double>& toward) {
  const auto values = table.find_table("toward");
  if (!values) return;
  const std::vector<std::string> names = names_of(space);
  for (const std::string& key : values->keys()) {
    const auto found = std::find(names.begin(), names.end(), key);
    if (found == names.end())
      values->reject(key, "is the name of no variable" + did_you_mean(key, names));
    const auto i = static_cast<int>(found - names.begin());
    if (!candidates.contains(i))
      values->reject(key, "is no candidate: `of` does not name it, so it is never dropped");
    const DesignVariable& variable = space[i];
    const double value = values->quantity(key, si_unit(Unit::of(variable.unit).dimension()));
    if (value < variable.lower || value > variable.upper)
      values->reject(key,
                     fmt::format("lies outside of the bounds {} .. {} of the variable, inside of "
                                 "which every fit has to stay; widen them",
                                 format_quantity(variable.lower, variable.unit, 5),
                                 format_quantity(variable.upper, variable.unit, 5)));
    toward[static_cast<std::size_t>(i)] = value;
  }
}

std::vector<SelectionUnit> read_units(const Node& table,
                                      const std::set<int>& candidates,
                                      const DesignSpace& space) {
  std::vector<SelectionUnit> units;
  std::map<int, std::string> grouped;
  if (const auto groups = table.find_table("groups")) {
    for (const std::string& name : groups->keys()) {
      const std::set<int> members = matching(*groups, name, space);
      for (const int i : members) {
        if (!candidates.contains(i))
          groups->reject(name,
                         "has " + space[i].name + ", which is no candidate: `of` does not name it");
        if (!grouped.emplace(i, name).second)
          groups->reject(name, "has " + space[i].name + ", which group " + grouped[i] + " has too");
      }
      units.push_back({name, {members.begin(), members.end()}});
    }
  }
  for (const int i : candidates)
    if (!grouped.contains(i)) units.push_back({space[i].name, {i}});
  std::stable_sort(units.begin(), units.end(), [](const auto& a, const auto& b) {
    return a.variables.front() < b.variables.front();
  });
  return units;
}

}  // namespace

SelectionSettings selection_of_all(const DesignSpace& space) {
  SelectionSettings settings;
  settings.toward = space.initial().values;
  for (int i = 0; i < space.size(); ++i) settings.units.push_back({space[i].name, {i}});
  return settings;
}

SelectionSettings read_coefficient_selection(const Node& table, const DesignSpace& space) {
  SelectionSettings settings = selection_of_all(space);
  std::set<int> candidates;
  for (int i = 0; i < space.size(); ++i) candidates.insert(i);
  if (table.has("of")) candidates = matching(table, "of", space);
  read_toward(table, candidates, space, settings.toward);
  settings.units = read_units(table, candidates, space);
  const std::string criterion =
      table.choice("criterion", {"bic", "aicc", "cross_validation"}, "bic");
  settings.criterion = criterion == "bic"    ? SelectionCriterion::bic
                       : criterion == "aicc" ? SelectionCriterion::aicc
                                             : SelectionCriterion::cross_validation;
  settings.refits =
      static_cast<int>(table.integer("refits", 1, kMostSelectionRefits, settings.refits));
  settings.honest = table.flag("honest", settings.honest);
  settings.seed = table.integer("seed", 0, std::numeric_limits<int>::max(), 0);
  return settings;
}

}  // namespace latsch::correlation
