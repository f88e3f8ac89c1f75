// SPDX-License-Identifier: Apache-2.0
#include "correlation/target/weighing.h"

#include <cmath>

namespace latsch::correlation {

std::vector<StudyExperiment> fitted_experiments(const Study& study) {
  std::vector<StudyExperiment> fitted;
  for (const StudyExperiment& experiment : study.experiments) {
    if (experiment.fitted) fitted.push_back(experiment);
  }
  return fitted;
}

std::optional<double> common_deviation(const std::vector<StudyExperiment>& fitted) {
  double weights = 0.0, count = 0.0;
  for (const StudyExperiment& experiment : fitted) {
    if (!(experiment.objective.weight > 0.0)) continue;
    if (!experiment.noise) return std::nullopt;
    for (const double sigma : stated_deviations(experiment)) {
      weights += 1.0 / (sigma * sigma);
      count += 1.0;
    }
  }
  return std::sqrt(count / weights);
}

void weigh(const StudyExperiment& experiment,
           const std::optional<double>& common,
           Comparison& comparison) {
  if (!common && experiment.loss.loss == Loss::squares) return;
  std::vector<double> sigma;
  if (common) sigma = stated_deviations(experiment);
  scale_by_noise(comparison, sigma, experiment.loss, sigma.empty() ? 1.0 : *common);
  comparison.value = 0.0;
  for (const double d : comparison.differences)
    comparison.value += std::pow(std::abs(d), experiment.objective.exponent);
  comparison.value /= static_cast<double>(comparison.differences.size());
}

}  // namespace latsch::correlation
