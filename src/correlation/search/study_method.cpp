// SPDX-License-Identifier: Apache-2.0
#include "correlation/search/study_method.h"

#include "correlation/target/study_trials.h"

namespace latsch::correlation {

namespace {

ProblemTraits traits_of(const Study& study) {
  ProblemTraits traits = traits_of_residuals(study.space, !study.constraints.empty());
  traits.noise_alone = noise_alone(study);
  return traits;
}

}  // namespace

MethodChoice method_of(const Study& study) {
  return latsch::method_of(study.optimizer, traits_of(study));
}

std::unique_ptr<Optimizer> make_optimizer(const Study& study) {
  return latsch::make_optimizer(
      method_of(study).method, study.space, study.optimizer, traits_of(study));
}

}  // namespace latsch::correlation
