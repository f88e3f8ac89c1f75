// SPDX-License-Identifier: Apache-2.0
#include "correlation/comparison/comparison_effects.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace latsch::correlation {

FactorialEffects effects_of(const std::array<std::array<double, 2>, 2>& d) {
  FactorialEffects effects;
  effects.distance = d;
  effects.first = 0.5 * ((d[1][0] + d[1][1]) - (d[0][0] + d[0][1]));
  effects.second = 0.5 * ((d[0][1] + d[1][1]) - (d[0][0] + d[1][0]));
  effects.interaction = 0.5 * ((d[1][1] - d[1][0]) - (d[0][1] - d[0][0]));
  effects.first_is_larger = std::abs(effects.first) > std::abs(effects.second) ? 1.0 : 0.0;
  return effects;
}

FactorialEffects mean_effects(const ModelComparisonFile& file,
                              const ModelComparison& comparison,
                              const std::vector<std::size_t>& cases,
                              std::size_t band,
                              bool in_decibels) {
  std::array<std::array<double, 2>, 2> sum{};
  double larger = 0.0;
  const auto count = static_cast<double>(cases.size());
  for (const std::size_t index : cases) {
    std::array<std::array<double, 2>, 2> one{};
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = 0; j < 2; ++j) {
        const ModelRun& run = comparison.cases[index].models[file.factorial_models[i][j]];
        one[i][j] = in_decibels ? run.mean_decibels(band) : run.mean_distance(band);
        sum[i][j] += one[i][j] / count;
      }
    larger += effects_of(one).first_is_larger / count;
  }
  FactorialEffects effects = effects_of(sum);
  effects.first_is_larger = larger;
  return effects;
}

double GridSensitivity::range(std::size_t model) const {
  const auto [low, high] = std::minmax_element(mean[model].begin(), mean[model].end());
  return *high - *low;
}

std::vector<GridSensitivity> sensitivities(const ModelComparisonFile& file,
                                           const ModelComparison& comparison) {
  std::vector<GridSensitivity> all;
  for (std::size_t t = 0; t < file.tests.size(); ++t) {
    for (std::size_t v = 0; v < file.tests[t].varied.size(); ++v) {
      const std::size_t levels = file.tests[t].varied[v].values.size();
      if (levels < 2) continue;
      GridSensitivity one{t, v, {}};
      for (std::size_t m = 0; m < file.models.size(); ++m) {
        one.mean.emplace_back();
        for (std::size_t level = 0; level < levels; ++level) {
          std::vector<std::size_t> at_level;
          for (const std::size_t index : cases_of(file, t))
            if (file.cases[index].levels[v] == level) at_level.push_back(index);
          one.mean.back().push_back(mean_distance(comparison, at_level, m, 0));
        }
      }
      all.push_back(std::move(one));
    }
  }
  return all;
}

std::vector<std::size_t> cases_of(const ModelComparisonFile& file, std::size_t test) {
  std::vector<std::size_t> cases;
  for (std::size_t i = 0; i < file.cases.size(); ++i)
    if (file.cases[i].test == test) cases.push_back(i);
  return cases;
}

std::vector<std::size_t> all_cases(const ModelComparisonFile& file) {
  std::vector<std::size_t> cases(file.cases.size());
  std::iota(cases.begin(), cases.end(), 0);
  return cases;
}

double mean_distance(const ModelComparison& comparison,
                     const std::vector<std::size_t>& cases,
                     std::size_t model,
                     std::size_t band,
                     bool in_decibels) {
  double sum = 0.0;
  for (const std::size_t index : cases) {
    const ModelRun& run = comparison.cases[index].models[model];
    sum += in_decibels ? run.mean_decibels(band) : run.mean_distance(band);
  }
  return sum / static_cast<double>(cases.size());
}

}  // namespace latsch::correlation
