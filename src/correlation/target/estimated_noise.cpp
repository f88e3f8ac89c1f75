// SPDX-License-Identifier: Apache-2.0
#include "correlation/target/estimated_noise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace latsch::correlation {
namespace {

// least noise, as a share of 100 %, for a model that reproduces the measurement exactly
constexpr double kLeast = 1e-9;

}  // namespace

double rms_error(const StudyExperiment& experiment,
                 const std::vector<StudyExperiment>& experiments,
                 const Channels& at) {
  const Comparison comparison = compare(experiment, experiments, at);
  const auto unit = experiment.observable->deviations({.relative = 1.0}, experiment.objective);
  const auto& missing = comparison.pairing.missing;
  double squares = 0.0, count = 0.0;
  for (std::size_t k = 0; k < unit.size(); ++k) {
    if (std::find(missing.begin(), missing.end(), static_cast<int>(k)) != missing.end()) continue;
    const double d = comparison.differences[k] / unit[k];
    squares += d * d;
    count += 1.0;
  }
  return count > 0.0 ? std::sqrt(squares / count) : 1.0;
}

bool estimates_noise(const Study& study) {
  return std::any_of(study.experiments.begin(), study.experiments.end(), [](const auto& one) {
    return one.estimates_noise;
  });
}

bool has_noise_of_own_stages(const Study& study) {
  return std::any_of(study.experiments.begin(), study.experiments.end(), [](const auto& one) {
    return one.noise_of_own_stage;
  });
}

void estimate_noise(Study& study, const Channels* at, const std::vector<double>& own_stages) {
  double values = 0.0;
  for (const StudyExperiment& experiment : study.experiments)
    if (experiment.estimates_noise) values += static_cast<double>(experiment.values());
  const double variables = study.space.size();
  const double left = values > variables ? 1.0 - variables / values : 1.0;
  for (std::size_t e = 0; e < study.experiments.size(); ++e) {
    StudyExperiment& experiment = study.experiments[e];
    if (!experiment.estimates_noise) continue;
    experiment.noise.reset();
    if (!at) continue;
    const bool has_own =
        experiment.noise_of_own_stage && e < own_stages.size() && std::isfinite(own_stages[e]);
    const double rms =
        has_own ? own_stages[e] : rms_error(experiment, study.experiments, *at) / std::sqrt(left);
    experiment.noise = {.relative = std::max(kLeast, rms)};
  }
}

void take_noise(const Study& stage, Study& study) {
  for (std::size_t e = 0; e < study.experiments.size(); ++e)
    if (study.experiments[e].estimates_noise)
      study.experiments[e].noise = stage.experiments[e].noise;
}

void take_stage(const Study& stage, Study& study) {
  take_noise(stage, study);
  for (std::size_t e = 0; e < study.experiments.size(); ++e)
    study.experiments[e].objective.weight = stage.experiments[e].objective.weight;
  study.free = stage.free;
  study.held_at = stage.held_at;
}

std::string noise_in_words(const Study& study) {
  std::string text;
  for (const StudyExperiment& experiment : study.experiments)
    if (experiment.estimates_noise && experiment.noise)
      text += fmt::format("{}{} {:.3g} %",
                          text.empty() ? "" : ", ",
                          experiment.name,
                          100.0 * experiment.noise->relative);
  return text;
}

}  // namespace latsch::correlation
