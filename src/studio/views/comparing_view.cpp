// SPDX-License-Identifier: Apache-2.0
// Compares two studies by the variables and experiments that have the same name in both.
#include <algorithm>

#include "base/error.h"
#include "base/units.h"
#include "studio/views/json_values.h"
#include "studio/views/kept_identifiability.h"
#include "studio/views/views.h"

namespace latsch::studio {
namespace {

constexpr const char* kNoTrial = "no trial has succeeded yet";

struct Side {
  std::string id, title;
  std::shared_ptr<const correlation::Study> study;
  std::optional<DesignPoint> best;
  Json target = nullptr;
  std::map<std::string, double> errors;  // errors of the experiments, each in its own measure
  Json convergence;
  KeptIdentifiability kept;
  std::string no_intervals;  // reason why there are no intervals
};

Side side_of(const ShelvedStudy& shelved) {
  Side side{};
  side.id = shelved.id();
  side.convergence = convergence_view(shelved, {.most = 600}, "");
  side.convergence.erase("failed");
  shelved.look([&](const ShelvedStudy::Sight& sight) {
    if (!sight.study) throw InputError(side.id + " cannot be read: " + sight.error);
    side.title = sight.study->title;
    side.study = sight.study;
    const auto best = sight.table->best();
    if (!best) return;
    const TableRow& row = sight.table->rows()[*best];
    const auto& target = sight.table->target();
    side.best = row.point;
    side.target = finite(target.weighting(target.weights()).target(*row.parts));
    const auto names = target.experiments();
    for (std::size_t e = 0; e < names.size(); ++e) side.errors[names[e]] = row.parts->errors[e];
  });
  side.kept = kept_identifiability(shelved);
  side.no_intervals = side.best ? side.kept.why_not_at(*side.best) : kNoTrial;
  return side;
}

bool has(const auto& named, const std::string& name) {
  return std::any_of(named.begin(), named.end(), [&](const auto& one) { return one.name == name; });
}

/// Returns a reason if a study lacks a value for a variable or an error of an experiment; empty if
/// it has one.
std::string lack(const Side& side, const auto& named, const std::string& name, const char* words) {
  if (!has(named, name)) return words;
  return side.best ? "" : kNoTrial;
}

Json value_of(const Side& side, const std::string& name, const std::string& unit) {
  if (!side.best) return nullptr;
  for (int i = 0; i < side.study->space.size(); ++i)
    if (side.study->space[i].name == name)
      return in_unit(side.best->values[static_cast<std::size_t>(i)], unit);
  return nullptr;
}

Json interval_of(const Side& side, const std::string& name) {
  if (!side.no_intervals.empty()) return "";
  for (int i = 0; i < side.study->space.size(); ++i)
    if (side.study->space[i].name == name)
      return correlation::interval_text(*side.study, *side.kept.what, i);
  return "";
}

/// Returns the names that occur in either map, those of the first one first.
template <class Named>
std::vector<std::string> names_of(const Named& a, const Named& b) {
  std::vector<std::string> names;
  for (const auto* list : {&a, &b})
    for (const auto& one : *list)
      if (std::find(names.begin(), names.end(), one.name) == names.end()) names.push_back(one.name);
  return names;
}

std::string unit_of(const Side& a, const Side& b, const std::string& name) {
  for (const Side* side : {&a, &b})
    for (const DesignVariable& v : side->study->space.variables())
      if (v.name == name) return v.unit;
  return "1";
}

}  // namespace

Json comparing_view(const ShelvedStudy& first, const ShelvedStudy& second) {
  const Side a = side_of(first), b = side_of(second);
  Json view{{"studies", Json::array()},
            {"variables", Json::array()},
            {"experiments", Json::array()},
            {"convergence", {a.convergence, b.convergence}}};
  for (const Side* side : {&a, &b})
    view["studies"].push_back({{"study", side->id},
                               {"title", side->title},
                               {"target", side->target},
                               {"no_intervals", side->no_intervals}});
  const auto lacks = [&](const std::string& name, const char* words, const auto& named_of) {
    return Json{lack(a, named_of(a), name, words), lack(b, named_of(b), name, words)};
  };
  for (const std::string& name : names_of(a.study->space.variables(), b.study->space.variables())) {
    const std::string unit = unit_of(a, b, name);
    view["variables"].push_back({{"name", name},
                                 {"unit", unit},
                                 {"values", {value_of(a, name, unit), value_of(b, name, unit)}},
                                 {"intervals", {interval_of(a, name), interval_of(b, name)}},
                                 {"missing",
                                  lacks(
                                      name, "not varied", [](const Side& side) -> const auto& {
                                        return side.study->space.variables();
                                      })}});
  }
  for (const std::string& name : names_of(a.study->experiments, b.study->experiments)) {
    const auto error = [&](const Side& side) {
      const auto found = side.errors.find(name);
      return found == side.errors.end() ? Json(nullptr) : finite(found->second);
    };
    view["experiments"].push_back(
        {{"name", name},
         {"errors", {error(a), error(b)}},
         {"missing",
          lacks(
              name, "not in this study", [](const Side& side) -> const auto& {
                return side.study->experiments;
              })}});
  }
  return view;
}

}  // namespace latsch::studio
