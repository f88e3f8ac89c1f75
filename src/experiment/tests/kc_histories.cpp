// SPDX-License-Identifier: Apache-2.0
#include "experiment/tests/kc_histories.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace latsch::experiment {
namespace {

MeasuredCondition condition_of(const Prescribed& of) {
  return {
      .channel = of.name, .unit = of.unit, .frame = of.frame, .acts_at_origin = !of.frame.empty()};
}

std::vector<double> one_history(const Node& root, const Prescribed& of, const TestSource& source) {
  const auto from = find_measured(root, of.name);
  if (!from) return root.one_or_more(of.name, of.unit);
  MeasuredCondition condition = condition_of(of);
  condition.is_needed = true;
  return take_measured(*from, {condition}, source.measured)[of.name];
}

}  // namespace

Histories::Histories(const Node& root,
                     const TestSource& source,
                     const std::vector<Prescribed>& loads,
                     const std::vector<Prescribed>& others,
                     const char* example) {
  const auto recorded = find_measured(root, "loads");
  if (recorded) {
    std::vector<MeasuredCondition> conditions;
    for (const Prescribed& load : loads) {
      conditions.push_back(condition_of(load));
      conditions.back().otherwise = "0";
    }
    const Channels channels = take_measured(*recorded, conditions, source.measured);
    for (const Channel& channel : channels.all()) values_[channel.name] = channel.values;
    if (values_.empty())
      root.reject("loads", "has none of Fx, Fy, Fz, Mx, My, Mz: no load was recorded");
  }
  for (const auto* list : {&loads, &others})
    for (const Prescribed& of : *list) {
      if (root.has(of.name)) {
        if (values_.contains(of.name))
          root.reject(of.name, "is given beside loads, which was recorded with it");
        values_[of.name] = one_history(root, of, source);
      }
      if (values_.contains(of.name)) stated_.push_back(of);
    }
  for (const auto& [name, values] : values_) states_ = std::max(states_, values.size());
  if (values_.empty()) {
    // If no load is stated, the only key may be misspelled, so unknown keys are reported first,
    // unless some keys are read later.
    if (!root.has("mode") && !root.has("slopes_by") && !root.has("window")) root.close();
    // throws with the name of the key that was probably intended
    root.one_or_more(example, loads[0].unit);
  }
  if (states_ == 0)
    root.reject(stated_.front().name, "is empty, expected the loads of one state at least");
  for (auto& [name, values] : values_) {
    if (values.size() != 1 && values.size() != states_)
      root.reject(
          name,
          fmt::format(
              "has {} values, expected one or {} as the others have", values.size(), states_));
    if (values.size() == 1) values.assign(states_, values[0]);
    if (!std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); }))
      root.reject(recorded && !root.has(name) ? "loads" : name, "has values that are not numbers");
  }
}

const std::vector<double>* Histories::find(const std::string& name) const {
  const auto found = values_.find(name);
  return found == values_.end() ? nullptr : &found->second;
}

std::optional<SlopesBy> Histories::slopes(const Node& root) const {
  if (!root.has("slopes_by")) {
    if (root.has("window")) root.reject("window", "belongs to slopes_by, which is missing");
    return std::nullopt;
  }
  std::vector<std::string> names;
  for (const Prescribed& of : stated_) names.push_back(of.name);
  const std::string by = root.choice("slopes_by", names);
  const auto of = std::find(names.begin(), names.end(), by) - names.begin();
  SlopesBy slopes{by, stated_[static_cast<std::size_t>(of)].unit};
  if (root.has("window")) {
    const auto window = root.quantities("window", slopes.unit);
    if (window.size() != 2 || !(window[0] < window[1]))
      root.reject("window", "is not a window, expected two values that rise");
    slopes.from = window[0];
    slopes.to = window[1];
  }
  if (slopes.weights(values_.at(by)).size() == 0)
    root.reject("slopes_by",
                "is " + by + ", which does not vary" +
                    (root.has("window") ? " in the window" : "") + ", so no slope can be computed");
  return slopes;
}

}  // namespace latsch::experiment
