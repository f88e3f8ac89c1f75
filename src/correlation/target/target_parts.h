// SPDX-License-Identifier: Apache-2.0
// Splits the target of a trial into the parts of its experiments, so that another set of weights
// does not need the channels again:
//
//   target(w) = sum w_e n_e f^k_e T_e / sum w_e n_e + f^k P / sum w_e n_e
//
// Here T_e is the part of experiment e with the study's own weights, P the sum of the priors, and k
// the exponents. If no noise is stated, n_e = 1 and f = 1. Otherwise n_e is the number of values,
// and f the common deviation of the experiments that count, over that with the study's own weights.
// With the study's own weights the sum equals the target of objective() to rounding.
#pragma once

#include <optional>
#include <vector>

#include "correlation/study/study.h"

namespace latsch::correlation {

/// The parts of the target of one trial, one for each fitted experiment in the order of the study.
struct TargetParts {
  std::vector<double> values;  // T_e
  std::vector<double> errors;  // own_measure() of each experiment
  std::vector<double> largest_errors;
  double priors = 0.0;     // P
  double violation = 0.0;  // violation of the constraints on channels
};

class PartedTarget {
 public:
  explicit PartedTarget(const Study& study);

  /// Returns the names of the fitted experiments.
  std::vector<std::string> experiments() const;
  /// Returns the weights of the study.
  const std::vector<double>& weights() const { return weights_; }

  /// Computes the parts of a trial. Fails if its channels leave nothing to compare.
  Result<TargetParts> parts(const DesignPoint& point, const Channels& channels) const;

  /// One weight for each experiment; it combines the parts of a target.
  class Weighting {
   public:
    double target(const TargetParts& parts) const;
    /// Returns the contribution of experiment e to the target.
    double share(const TargetParts& parts, std::size_t e) const;

   private:
    friend class PartedTarget;
    std::vector<double> factors_;  // w_e n_e f^k_e / sum w_e n_e
    double prior_ = 0.0;           // f^k / sum w_e n_e
  };

  /// Throws InputError if no weight is positive, or if one is negative or not finite.
  Weighting weighting(const std::vector<double>& weights) const;

 private:
  std::vector<StudyExperiment> fitted_;
  DesignSpace space_;
  std::vector<ChannelConstraint> constraints_;
  std::optional<double> common_;
  std::vector<double> weights_;
};

}  // namespace latsch::correlation
