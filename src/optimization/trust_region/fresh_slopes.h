// SPDX-License-Identifier: Apache-2.0
// Recomputes slopes at the end of a search, when no step predicts an improvement, with lengths
// suited to noise and ripple (natural_frame.h). Each round probes along the axes of a frame and
// then takes steps of the resulting model until one predicts no gain or several have failed to
// gain. Another round follows if the steps gained, or if slopes were wrong by more than noise; its
// probes go to other points. If the residuals are at noise level, one more round takes longer
// moves, over which noise counts less.
//
// The range of a variable may be so wide that a probe changes the residuals by hundreds of times
// their size, or makes them explode. Such a probe does not help to judge a minimum. The axis is
// then shortened until the residuals change by about their size, and probed again. If an axis has
// no usable probe, the search cannot confirm that it ended at a minimum: Ending::blind.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "optimization/trust_region/search_ending.h"
#include "optimization/trust_region/trust_box.h"

namespace latsch {

class FreshSlopes {
 public:
  struct Options {
    double shortest;     // shortest move for slopes, relative to a width
    double noise_alone;  // see ResidualTrustRegionOptions
    double f_least;      // a value below this is worth no further round
  };

  /// Starts around the center of the box.
  FreshSlopes(TrustBox& box, const Options& options);

  /// False if the region is a single point.
  bool has_axes() const { return frame_.axes() > 0; }
  /// Returns the next probe or step. Returns nullopt while outcomes of `wanted` must come first or,
  /// if `wanted` is empty, when the verification has ended.
  std::optional<Wanted> next(TrustBox& box, const PendingPoints<Wanted>& wanted);
  void observe_failed_step();
  /// `change` is the change of the residuals relative to their size, if the probe has residuals.
  void observe_failed_probe(double change);
  /// `is_bad` is true if the step gained almost nothing of the predicted gain.
  void observe_step(bool is_bad, double promise);

  /// Value of the target at the beginning of this round.
  double f_begin() const { return f_begin_; }
  /// True if moves had to be shortened to suit the residuals: no search in a box starts from
  /// there.
  bool is_sharp() const { return is_sharp_; }
  /// Valid once the verification has ended.
  Ending ending() const { return ending_; }
  /// Standard deviation of the value caused by noise.
  double deviation() const { return deviation_; }

 private:
  void begin_round(const TrustBox& box, const Eigen::MatrixXd& J);
  bool pays_another_round(const TrustBox& box) const;
  void shorten(int axis, double factor);
  bool sharpen(const TrustBox& box);

  Options options_;
  NaturalFrame frame_;
  int axis_ = 0;  // next axis to probe
  int rounds_ = 0;
  double change_ = 1.0;            // relative change of the residuals along an axis
  double reach_ = 0.0;             // longest step, in axis coordinates
  int steps_ = 0;                  // number in this round
  int sharpened_ = 0;              // number of axes shortened in this round
  bool is_sharp_ = false;          // an axis was shortened, in any round
  bool is_blind_ = false;          // an axis of this round has no slope
  int misses_ = 0;                 // number of steps in a row that failed or disappointed
  bool has_failed_ = false;        // the last step failed
  bool has_disappointed_ = false;  // a step of this round disappointed, by more than noise explains
  double deviation_ = 0.0;
  double f_begin_ = 0.0;
  Ending ending_ = Ending::none;
};

}  // namespace latsch
