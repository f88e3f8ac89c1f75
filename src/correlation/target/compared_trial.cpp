// SPDX-License-Identifier: Apache-2.0
#include "correlation/target/compared_trial.h"

#include <utility>

namespace latsch::correlation {

Result<std::vector<Comparison>> compare_all(const std::vector<StudyExperiment>& experiments,
                                            const Channels& channels) {
  std::vector<Comparison> comparisons;
  for (const StudyExperiment& experiment : experiments) {
    auto comparison = experiment.observable->compare(channels, experiment.objective);
    if (!comparison) return comparison.failure();  // a measurement may have grown since the trial
    comparisons.push_back(std::move(*comparison));
  }
  return comparisons;
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
