// SPDX-License-Identifier: Apache-2.0
#include "correlation/search/study_method.h"

#include <fmt/format.h>

#include "correlation/study/study_slopes.h"
#include "correlation/target/study_trials.h"
#include "optimization/strategy/held_variables.h"

namespace latsch::correlation {

namespace {

ProblemTraits traits_of(const Study& study) {
  ProblemTraits traits = traits_of_residuals(study.space, !study.constraints.empty());
  if (!study.free.empty()) traits.variables = static_cast<int>(std::ssize(study.free));
  traits.has_jacobian = !reason_without_slopes(study);
  for (const StudyExperiment& experiment : study.experiments) {
    if (experiment.fitted && experiment.objective.weight > 0.0)
      traits.values += static_cast<long>(experiment.values());
  }
  traits.noise_alone = noise_alone(study);
  traits.square_of_data = 1.0;  // residuals are shares of the measured values' scales
  return traits;
}

}  // namespace

MethodChoice method_of(const Study& study) {
  return latsch::method_of(study.optimizer, traits_of(study));
}

std::unique_ptr<Optimizer> make_optimizer(const Study& study) {
  const Method method = method_of(study).method;
  const auto reason = reason_without_slopes(study);
  if (method == Method::levenberg_marquardt && reason)
    throw InputError({study.file.string(), 0},
                     fmt::format("optimizer.method is \"{}\", which goes by the slopes of the "
                                 "residuals, but {}; expected \"auto\" or another method",
                                 name(method),
                                 *reason));
  const auto make = [&](const DesignSpace& space) {
    return latsch::make_optimizer(method, space, study.optimizer, traits_of(study));
  };
  if (study.free.empty()) return make(study.space);
  return std::make_unique<HeldVariables>(study.space, study.free, make);
}

}  // namespace latsch::correlation
