// SPDX-License-Identifier: Apache-2.0
// The target of a trial taken apart into those of its experiments, so that another set of weights
// needs no channel again:
//
//   target(w) = sum w_e n_e f^k_e T_e / sum w_e n_e + f^k P / sum w_e n_e
//
// T_e the part of experiment e at the study's own weights, P the sum of the priors, k the
// exponents; n_e = 1 and f = 1 where no noise is stated, else n_e the number of values and f the
// common deviation of those experiments that count over that of the study's own. With the study's
// own weights it is the target of objective() to rounding.
#pragma once

#include <optional>
#include <vector>

#include "correlation/study/study.h"

namespace latsch::correlation {

/// Of one trial; an experiment each, the fitted ones in the order of the study.
struct TargetParts {
  std::vector<double> values;       // T_e
  std::vector<double> mean_errors;  // mean |dF| or |df|
  std::vector<double> largest_errors;
  double priors = 0.0;     // P
  double violation = 0.0;  // of the constraints on channels
};

class PartedTarget {
 public:
  explicit PartedTarget(const Study& study);

  /// Names of the fitted experiments.
  std::vector<std::string> experiments() const;
  /// As the study has them.
  const std::vector<double>& weights() const { return weights_; }

  /// A Failure where the channels leave nothing to compare.
  Result<TargetParts> parts(const DesignPoint& point, const Channels& channels) const;

  /// What a set of weights, one each, makes of parts.
  class Weighting {
   public:
    double target(const TargetParts& parts) const;
    /// What experiment e adds to it.
    double share(const TargetParts& parts, std::size_t e) const;

   private:
    friend class PartedTarget;
    std::vector<double> factors_;  // w_e n_e f^k_e / sum w_e n_e
    double prior_ = 0.0;           // f^k / sum w_e n_e
  };

  /// Throws InputError where no weight is positive or one is negative or not finite.
  Weighting weighting(const std::vector<double>& weights) const;

 private:
  std::vector<StudyExperiment> fitted_;
  DesignSpace space_;
  std::vector<ChannelConstraint> constraints_;
  std::optional<double> common_;
  std::vector<double> weights_;
};

}  // namespace latsch::correlation
