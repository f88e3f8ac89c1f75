// SPDX-License-Identifier: Apache-2.0
#include "correlation/target/compared_trial.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace latsch::correlation {

double own_measure(const StudyExperiment& experiment, const Comparison& comparison) {
  return std::pow(comparison.value, 1.0 / experiment.objective.exponent);
}

std::string measure_in_words(const StudyExperiment& experiment) {
  const double k = experiment.objective.exponent;
  if (k == 1.0) return "mean";
  return k == 2.0 ? "RMS" : fmt::format("mean to the power {:g}", k);
}

std::vector<NuisancePrior> nuisance_priors(const std::vector<StudyExperiment>& experiments,
                                           std::size_t e,
                                           const Comparison& comparison) {
  std::vector<NuisancePrior> priors;
  if (comparison.nuisance.empty()) return priors;
  for (const std::size_t k : counted_numbers(experiments, e)) {
    const SolvedNumber& number = comparison.nuisance[k];
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
