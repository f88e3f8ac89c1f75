// SPDX-License-Identifier: Apache-2.0
#include "correlation/residuals.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/units.h"
#include "correlation/tire_trials.h"

namespace latsch::correlation {
namespace {

bool counts(const StudyExperiment& experiment) {
  return experiment.fitted && experiment.objective.weight > 0.0;
}

double factor(const StudyExperiment& experiment) {
  return experiment.noise ? 1.0 / *experiment.noise : std::sqrt(experiment.objective.weight);
}

}  // namespace

std::optional<double> residual_sigma(const Study& study) {
  const bool stated = std::all_of(study.experiments.begin(),
                                  study.experiments.end(),
                                  [](const auto& e) { return !counts(e) || e.noise; });
  return stated ? std::optional(1.0) : std::nullopt;
}

Objective residual_objective(const Study& study) {
  std::vector<StudyExperiment> experiments;
  std::copy_if(
      study.experiments.begin(), study.experiments.end(), std::back_inserter(experiments), counts);
  return [experiments](const Channels& channels) -> Result<Score> {
    Score score;
    for (const StudyExperiment& experiment : experiments) {
      const Comparison comparison = compare(experiment, channels_of(experiment, channels));
      std::vector<double> errors = comparison.errors;
      for (int missing : comparison.pairing.missing) {
        errors[missing] = std::numeric_limits<double>::quiet_NaN();
      }
      for (double d : errors) {
        score.residuals.push_back(factor(experiment) * d);
        if (std::isfinite(d)) score.value += score.residuals.back() * score.residuals.back();
      }
    }
    return score;
  };
}

std::vector<ResidualRow> residual_rows(const Study& study) {
  std::vector<ResidualRow> rows;
  for (size_t e = 0; e < study.experiments.size(); ++e) {
    const StudyExperiment& experiment = study.experiments[e];
    if (!counts(experiment)) continue;
    const int place = static_cast<int>(e);
    if (experiment.curve) {
      for (std::string& name : value_names(*experiment.curve)) rows.push_back({place, name});
      continue;
    }
    for (const ModeRecord& mode : experiment.modes) rows.push_back({place, mode.label()});
    if (experiment.modal()) continue;
    const auto& test = std::get<experiment::LoadDeflection>(experiment.load_case.test);
    for (double x : test.loaded_radii.empty() ? test.deflections : test.loaded_radii) {
      rows.push_back({place, format_quantity(x, "mm", 4)});
    }
  }
  return rows;
}

}  // namespace latsch::correlation
