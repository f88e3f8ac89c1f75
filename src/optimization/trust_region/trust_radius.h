// SPDX-License-Identifier: Apache-2.0
// The radius of a residual trust region: how gains, disappointments, failures and noise change it.
#pragma once

#include <utility>

#include "optimization/trust_region/trust_box.h"
#include "optimization/trust_region/trust_region_tuning.h"

namespace latsch {

class TrustRadius {
 public:
  TrustRadius(double initial, const RadiusTuning& tuning) : tuning_(tuning), initial_(initial) {}

  bool is_good(double gain) const { return gain > tuning_.good_gain; }
  bool is_bad(double gain) const { return gain < tuning_.bad_gain; }

  /// Must be called for every outcome, before the functions that change the radius.
  void observe_outcome() { widened_since_outcome_ = 0; }
  void observe_success() { failures_ = 0; }
  void observe_failure() { ++failures_; }
  /// Adjusts the radius after a step. `gain` is the ratio of the actual to the predicted gain.
  void judge_step(TrustBox& box, const Wanted& step, double gain, bool is_best, bool is_of_center);
  /// Shrinks the radius if several evaluations in a row have failed.
  void shrink_after_failure(TrustBox& box, const Wanted& failed) const;
  /// Shrinks the radius if no step in the box is worth an evaluation.
  void shrink_without_step(TrustBox& box) const {
    box.radius *= box.noise > 0.0 ? tuning_.without_step_in_noise : tuning_.without_step;
  }
  /// Sets the radius for a new search.
  void begin(TrustBox& box, double radius);

  /// Number of failures in a row.
  int failures() const { return failures_; }
  /// True unless so many probes in a row failed around the center that no more are made.
  bool bears_probes() const { return failures_ < tuning_.failures_to_give_up; }
  /// True if a step has disappointed since the last call.
  bool doubts_geometry() { return std::exchange(is_geometry_doubted_, false); }
  /// True if so many steps disappointed that the model has to estimate the noise.
  bool suspects_noise() const { return disappointments_ >= tuning_.disappointments; }

  /// Doubles the radius if noise is as large as the effect of the slopes. Returns false if the
  /// radius stays.
  bool widen_if_drowned(TrustBox& box);
  /// If noise led the steps into a box so small that outcomes contain only noise, widens it to
  /// twice the radius at which the effect of curvature, whose variance is proportional to radius^4,
  /// is as large as noise. Returns false if the radius stays.
  bool widen_in_noise(TrustBox& box);

 private:
  RadiusTuning tuning_;
  double initial_;
  /// A step has disappointed since the geometry was last examined.
  bool is_geometry_doubted_ = false;
  int disappointments_ = 0;        // number of disappointing steps in a row
  int failures_ = 0;               // number of failures in a row
  int widened_since_outcome_ = 0;  // number of times the radius was doubled since the last outcome
  int widenings_ = 0;              // number of times the box was widened at noise level
};

}  // namespace latsch
