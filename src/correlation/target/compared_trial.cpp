// SPDX-License-Identifier: Apache-2.0
#include "correlation/target/compared_trial.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace latsch::correlation {

Result<std::vector<Comparison>> compare_all(const std::vector<StudyExperiment>& experiments,
                                            const Channels& channels) {
  std::vector<Comparison> comparisons;
  for (const StudyExperiment& experiment : experiments) {
    auto comparison = comparison_of(experiment, channels);
    if (!comparison) return comparison.failure();  // a measurement may have grown since the trial
    comparisons.push_back(std::move(*comparison));
  }
  return comparisons;
}

double own_measure(const StudyExperiment& experiment, const Comparison& comparison) {
  return std::pow(comparison.value, 1.0 / experiment.objective.exponent);
}

std::string measure_in_words(const StudyExperiment& experiment) {
  const double k = experiment.objective.exponent;
  if (k == 1.0) return "mean";
  return k == 2.0 ? "RMS" : fmt::format("mean to the power {:g}", k);
}

std::vector<NuisancePrior> nuisance_priors(const Comparison& comparison) {
  std::vector<NuisancePrior> priors;
  for (const SolvedNumber& number : comparison.nuisance) {
    if (number.is_free()) continue;
    priors.push_back({number.value / number.prior, number.slopes});
    for (double& slope : priors.back().slopes) slope /= number.prior;
  }
  return priors;
}

std::vector<PriorResidual> prior_residuals(const DesignSpace& space, const DesignPoint& point) {
  std::vector<PriorResidual> residuals;
  for (int i = 0; i < space.size(); ++i) {
    if (!space[i].prior) continue;
    const double x = point.values[static_cast<std::size_t>(i)];
    residuals.push_back({i, space[i].prior->residual(x), space[i].prior->slope(x)});
  }
  return residuals;
}

}  // namespace latsch::correlation
