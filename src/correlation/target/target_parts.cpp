// SPDX-License-Identifier: Apache-2.0
#include "correlation/target/target_parts.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/error.h"
#include "correlation/target/compared_trial.h"
#include "correlation/target/weighing.h"

namespace latsch::correlation {

PartedTarget::PartedTarget(const Study& study)
    : fitted_(fitted_experiments(study)),
      space_(study.space),
      constraints_(study.constraints),
      common_(common_deviation(fitted_)) {
  for (const StudyExperiment& experiment : fitted_) weights_.push_back(experiment.objective.weight);
}

std::vector<std::string> PartedTarget::experiments() const {
  std::vector<std::string> names;
  for (const StudyExperiment& experiment : fitted_) names.push_back(experiment.name);
  return names;
}

Result<TargetParts> PartedTarget::parts(const DesignPoint& point, const Channels& channels) const {
  auto comparisons = compare_all(fitted_, channels);
  if (!comparisons) return comparisons.failure();
  TargetParts parts;
  for (std::size_t e = 0; e < fitted_.size(); ++e) {
    Comparison& comparison = (*comparisons)[e];
    parts.errors.push_back(own_measure(fitted_[e], comparison));
    parts.largest_errors.push_back(comparison.largest_error);
    weigh(fitted_[e], common_, comparison);
    parts.values.push_back(comparison.value);
  }
  if (common_) {
    const double exponent = fitted_.front().objective.exponent;
    for (const PriorResidual& prior : prior_residuals(space_, point))
      parts.priors += std::pow(std::abs(*common_ * prior.residual), exponent);
  }
  Score limits;
  for (const ChannelConstraint& constraint : constraints_)
    if (const Status done = apply(constraint, channels, limits); !done) return done.failure();
  parts.violation = violation(limits);
  return parts;
}

PartedTarget::Weighting PartedTarget::weighting(const std::vector<double>& weights) const {
  std::vector<StudyExperiment> weighted = fitted_;
  double largest = 0.0;
  for (std::size_t e = 0; e < weighted.size(); ++e) {
    if (!std::isfinite(weights[e]) || weights[e] < 0.0)
      throw InputError("the weight of experiment " + weighted[e].name +
                       " is negative or no number; expected one from 0 up");
    largest = std::max(largest, weights[e]);
  }
  if (!(largest > 0.0)) throw InputError("all weights are 0: at least one experiment has to count");
  // the weights are scaled so that their sum cannot overflow
  for (std::size_t e = 0; e < weighted.size(); ++e)
    weighted[e].objective.weight = weights[e] / largest;
  const auto common = common_deviation(weighted);
  // either all experiments state their noise, or none does
  assert(common.has_value() == common_.has_value());
  const double f = common ? *common / *common_ : 1.0;
  Weighting result;
  double total = 0.0;
  for (const StudyExperiment& experiment : weighted) {
    const double n = common ? static_cast<double>(experiment.values()) : 1.0;
    result.factors_.push_back(experiment.objective.weight * n);
    total += result.factors_.back();
  }
  for (std::size_t e = 0; e < weighted.size(); ++e)
    result.factors_[e] *= std::pow(f, weighted[e].objective.exponent) / total;
  result.prior_ = std::pow(f, fitted_.front().objective.exponent) / total / largest;
  return result;
}

double PartedTarget::Weighting::share(const TargetParts& parts, std::size_t e) const {
  return factors_[e] * parts.values[e];
}

double PartedTarget::Weighting::target(const TargetParts& parts) const {
  double sum = parts.priors > 0.0 ? prior_ * parts.priors : 0.0;
  for (std::size_t e = 0; e < factors_.size(); ++e) sum += share(parts, e);
  return sum;
}

}  // namespace latsch::correlation
