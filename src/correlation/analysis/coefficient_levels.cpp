// SPDX-License-Identifier: Apache-2.0
#include "correlation/analysis/coefficient_levels.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "experiment/rigs/slip/condition_levels.h"

namespace latsch::correlation {
namespace {

std::set<std::string> tests_compared(const Study& study, bool fitted_only) {
  std::set<std::string> names;
  for (const StudyExperiment& experiment : study.experiments) {
    if (fitted_only && !experiment.fitted) continue;
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

std::vector<UntoldCoefficient> untold_coefficients(const Study& study) {
  if (driven_at(study, "Fz", /*fitted_only=*/true).empty()) return {};
  const auto values_of = [&](const std::string& channel) {
    std::vector<double> values = driven_at(study, channel, /*fitted_only=*/true);
    if (!values.empty()) return values;
    const char* own = channel == "p" ? "INFLPRES" : channel == "Vx" ? "LONGVL" : nullptr;
    if (own && study.model.root().has(own)) values = {study.model.get(own)};
    if (channel == "gamma") values = {0.0};
    return values;
  };
  std::vector<std::string> paths, variables;
  for (const DesignVariable& variable : study.space.variables())
    for (const std::string& path : variable.paths) {
      paths.push_back(path);
      variables.push_back(variable.name);
    }
  const auto reasons = reasons_against(paths, values_of);
  std::vector<UntoldCoefficient> untold;
  for (std::size_t k = 0; k < paths.size(); ++k)
    if (!reasons[k].empty()) untold.push_back({variables[k], paths[k] + " is " + reasons[k]});
  return untold;
}

}  // namespace latsch::correlation
