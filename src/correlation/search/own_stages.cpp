// SPDX-License-Identifier: Apache-2.0
#include "correlation/search/own_stages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "correlation/study/study_stages.h"
#include "correlation/target/compared_trial.h"
#include "correlation/target/estimated_noise.h"

namespace latsch::correlation {
namespace {

// ratio of an error to the error at the end of the experiment's own stage, above which the error
// counts as worse
constexpr double kWorse = 1.05;
// share of 100 %; smaller differences are rounding of a finished search
constexpr double kNegligible = 1e-6;

/// Returns the noise that the study states, in the experiment's own measure; 0 if it states none or
/// if the fit estimates it.
double stated_noise(const StudyExperiment& experiment) {
  if (experiment.estimates_noise || !experiment.noise) return 0.0;
  double squares = 0.0, count = 0.0;
  for (const double sigma : stated_deviations(experiment)) {
    squares += sigma * sigma;
    count += 1.0;
  }
  return count > 0.0 ? std::sqrt(squares / count) : 0.0;
}

}  // namespace

void add_stage_end(const Study& study,
                   int k,
                   const Channels& recording,
                   std::vector<OwnStage>& own) {
  own.resize(study.experiments.size());
  if (study.stages.empty() || !study.stages[static_cast<std::size_t>(k)].numbers.empty()) return;
  const Study part = stage(study, k);
  for (std::size_t e = 0; e < own.size(); ++e) {
    const StudyExperiment& experiment = part.experiments[e];
    if (!experiment.fitted || !(experiment.objective.weight > 0.0)) continue;
    const auto comparison = comparison_of(experiment, part.experiments, recording);
    if (!comparison) continue;
    const double error = own_measure(experiment, *comparison);
    if (error < own[e].error)
      own[e] = {part.stage, error, rms_error(experiment, part.experiments, recording)};
  }
}

bool is_spoiled(const StudyExperiment& experiment, const OwnStage& own, double error) {
  return own.is_known() && error > kWorse * own.error && error - own.error > kNegligible &&
         error > stated_noise(experiment);
}

std::string spoiled_in_words(const StudyExperiment& experiment, const OwnStage& own, double error) {
  return fmt::format(
      "{} is worse than after an earlier stage: {} {:.3g} %, but {:.3g} % at the "
      "end of stage {}",
      experiment.name,
      measure_in_words(experiment),
      100.0 * error,
      100.0 * own.error,
      own.stage);
}

std::vector<std::string> spoiled_experiments(const Study& study,
                                             const std::vector<OwnStage>& own,
                                             const Channels& recording) {
  std::vector<std::string> all;
  for (std::size_t e = 0; e < std::min(own.size(), study.experiments.size()); ++e) {
    const StudyExperiment& experiment = study.experiments[e];
    if (!own[e].is_known()) continue;
    const auto comparison = comparison_of(experiment, study.experiments, recording);
    if (!comparison) continue;
    const double error = own_measure(experiment, *comparison);
    if (is_spoiled(experiment, own[e], error))
      all.push_back(spoiled_in_words(experiment, own[e], error));
  }
  return all;
}

}  // namespace latsch::correlation
