// SPDX-License-Identifier: Apache-2.0
// Slopes taken afresh where a search promises nothing any more, at lengths that noise and ripple
// allow (natural_frame.h): probes along the axes of a frame, then steps of the model they make
// until one promises nothing or several were in vain. Another round where they gained, or where
// slopes were wrong by more than noise: its probes go to other places. In the noise once more, over
// longer moves, over which noise counts less.
//
// The range of a variable may be so wide that a probe changes the residuals by hundreds of times
// what they are, or explodes: nothing follows from it about a minimum. Then the axis is shortened
// to where the residuals change by as much as they are, and probed again. Where an axis has no
// probe that serves, the search has not seen whether it ended at a minimum: Ending::blind.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "optimization/trust_region/search_ending.h"
#include "optimization/trust_region/trust_box.h"

namespace latsch {

class FreshSlopes {
 public:
  struct Options {
    double shortest;     // move for slopes, of a width
    double noise_alone;  // as in ResidualTrustRegionOptions
    double f_least;      // a value below it is worth no round more
  };

  /// Around the center of the box.
  FreshSlopes(TrustBox& box, const Options& options);

  /// False where the region is a point.
  bool has_axes() const { return frame_.axes() > 0; }
  /// The next probe or step. nullopt: outcomes of `wanted` come first or, where there are none, it
  /// has ended.
  std::optional<Wanted> next(TrustBox& box, const PendingPoints<Wanted>& wanted);
  void observe_failed_step();
  /// `change`: of the residuals over what they are, where the probe has any.
  void observe_failed_probe(double change);
  /// `is_bad`: it gained next to nothing of what it promised.
  void observe_step(bool is_bad, double promise);

  /// The value at the begin of this round.
  double f_begin() const { return f_begin_; }
  /// Moves are as short as the residuals ask for: no search in a box goes on from there.
  bool is_sharp() const { return is_sharp_; }
  /// Once it has ended.
  Ending ending() const { return ending_; }
  /// What noise makes of the value.
  double deviation() const { return deviation_; }

 private:
  void begin_round(const TrustBox& box, const Eigen::MatrixXd& J);
  bool pays_another_round(const TrustBox& box) const;
  void shorten(int axis, double factor);
  bool sharpen(const TrustBox& box);

  Options options_;
  NaturalFrame frame_;
  int axis_ = 0;  // the next to be probed
  int rounds_ = 0;
  double change_ = 1.0;            // of the residuals along an axis, of what they are
  double reach_ = 0.0;             // of steps, along the axes
  int steps_ = 0;                  // of this round
  int sharpened_ = 0;              // axes, in this round
  bool is_sharp_ = false;          // one was, in any round
  bool is_blind_ = false;          // an axis of this round has no slope
  int misses_ = 0;                 // steps in a row that failed or disappointed
  bool has_failed_ = false;        // the last step
  bool has_disappointed_ = false;  // in this round, by more than noise explains
  double deviation_ = 0.0;
  double f_begin_ = 0.0;
  Ending ending_ = Ending::none;
};

}  // namespace latsch
