// SPDX-License-Identifier: Apache-2.0
#include "correlation/analysis/coefficient_levels.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "correlation/study/study_stages.h"
#include "experiment/rigs/slip/condition_levels.h"

namespace latsch::correlation {
namespace {

std::set<std::string> tests_compared(const Study& study, bool fitted_only) {
  std::set<std::string> names;
  for (const StudyExperiment& experiment : study.experiments) {
    if (fitted_only && (!experiment.fitted || !(experiment.objective.weight > 0.0))) continue;
    for (const std::string& channel : experiment.observable->asks()) names.insert(test_of(channel));
  }
  return names;
}

}  // namespace

std::vector<double> driven_at(const Study& study, const std::string& condition, bool fitted_only) {
  std::vector<double> all;
  const auto compared = tests_compared(study, fitted_only);
  for (const StudyTest& test : study.tests) {
    if (!test.test || !compared.contains(test.name)) continue;
    const std::vector<double> values = test.test->driven_at(condition);
    all.insert(all.end(), values.begin(), values.end());
  }
  return all;
}

namespace {

/// Returns, for every variable, why the fitted experiments of one stage cannot determine its
/// coefficients; "" if they can. `part` may also be a study without stages.
std::vector<std::string> reasons_in(const Study& part) {
  std::vector<std::string> reasons(static_cast<std::size_t>(part.space.size()));
  if (driven_at(part, "Fz", /*fitted_only=*/true).empty()) return reasons;
  const auto values_of = [&](const std::string& channel) {
    std::vector<double> values = driven_at(part, channel, /*fitted_only=*/true);
    if (!values.empty()) return values;
    const char* own = channel == "p" ? "INFLPRES" : channel == "Vx" ? "LONGVL" : nullptr;
    if (own && part.model.root().has(own)) values = {part.model.get(own)};
    if (channel == "gamma") values = {0.0};
    return values;
  };
  std::vector<std::string> paths;
  std::vector<std::size_t> variables;
  for (int i = 0; i < part.space.size(); ++i)
    for (const std::string& path : part.space[i].paths) {
      paths.push_back(path);
      variables.push_back(static_cast<std::size_t>(i));
    }
  const auto against = reasons_against(paths, values_of);
  for (std::size_t k = 0; k < paths.size(); ++k)
    if (!against[k].empty()) reasons[variables[k]] = paths[k] + " is " + against[k];
  return reasons;
}

}  // namespace

std::vector<UntoldCoefficient> untold_coefficients(const Study& study) {
  if (study.stages.empty()) {
    std::vector<UntoldCoefficient> untold;
    const auto reasons = reasons_in(study);
    for (int i = 0; i < study.space.size(); ++i)
      if (const std::string& reason = reasons[static_cast<std::size_t>(i)]; !reason.empty())
        untold.push_back({study.space[i].name, reason});
    return untold;
  }
  // The last stage that names the variable decides; if none names it, the last stage that frees all
  // variables.
  std::vector<UntoldCoefficient> last(static_cast<std::size_t>(study.space.size()));
  std::vector<bool> is_named(last.size(), false);
  for (int k = 0; k < std::ssize(study.stages); ++k) {
    const std::vector<int>& free = study.stages[static_cast<std::size_t>(k)].free;
    const auto reasons = reasons_in(stage(study, k));
    for (std::size_t i = 0; i < last.size(); ++i) {
      const bool names = std::find(free.begin(), free.end(), static_cast<int>(i)) != free.end();
      if (!names && (!free.empty() || is_named[i])) continue;
      is_named[i] = is_named[i] || names;
      last[i] = {study.space[static_cast<int>(i)].name,
                 reasons[i],
                 study.stages[static_cast<std::size_t>(k)].name};
    }
  }
  std::erase_if(last, [](const UntoldCoefficient& one) { return one.reason.empty(); });
  return last;
}

}  // namespace latsch::correlation
