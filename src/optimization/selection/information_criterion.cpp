// SPDX-License-Identifier: Apache-2.0
#include "optimization/selection/information_criterion.h"

#include <cmath>

#include "optimization/problem/infinity.h"

namespace latsch {
namespace {

double with_noise(int k, const CountedValues& counted) {
  return static_cast<double>(counted.noise_known ? k : k + 1);
}

}  // namespace

double minus_two_log_likelihood(double S, const CountedValues& counted) {
  return counted.noise_known ? S : counted.values * std::log(S / counted.values);
}

double bic(double minus_two_log, int k, const CountedValues& counted) {
  return minus_two_log + with_noise(k, counted) * std::log(counted.independent);
}

double aicc(double minus_two_log, int k, const CountedValues& counted) {
  const double all = with_noise(k, counted), left = counted.independent - all - 1.0;
  if (!(left > 0.0)) return kInfinity;
  return minus_two_log + 2.0 * all + 2.0 * all * (all + 1.0) / left;
}

std::string in_words(SelectionCriterion criterion) {
  switch (criterion) {
    case SelectionCriterion::bic:
      return "BIC";
    case SelectionCriterion::aicc:
      return "AICc";
    case SelectionCriterion::cross_validation:
      break;
  }
  return "the squared error of recordings left out";
}

}  // namespace latsch
