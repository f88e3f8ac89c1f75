// SPDX-License-Identifier: Apache-2.0
// Recomputes slopes at the end of a search, when no step predicts an improvement, over lengths that
// suit noise and ripple (natural_frame.h). Each round evaluates one point (a probe) along each axis
// of a frame and then takes steps of the resulting model until one predicts no gain or several have
// failed to gain. Another round follows if the steps gained, or if slopes were wrong by more than
// noise explains; its probes go to other points. If the residuals are at noise level, one more
// round takes longer moves, over which noise counts less.
//
// The range of a variable may be so wide that a probe changes the residuals by hundreds of times
// their size, or makes them explode. Such a probe does not help to judge a minimum. The axis is
// then shortened until the residuals change by about their size, and probed again. If an axis has
// no usable probe, the search cannot confirm that it ended at a minimum: Ending::blind. Residuals
// that scatter because an axis is a small share of the ranges are not called noisy: Ending::wide.
//
// A model that passes through a ripple of the simulations finds a minimum of the ripple, at which
// it predicts no gain. The search therefore remembers bad steps until a step of similar promise
// gains what was predicted, and compares the residuals of one or two trials between the axes with
// the last model. If either shows that the slopes are wrong, the ending is Ending::noise or, if no
// model was noisy, Ending::rough.
//
// If next to nothing is left of the residuals at the end of the whole search, the probes alone show
// which variables the residuals determine (open_variables.h), and the verification ends if all are
// determined. If one is open, steps follow as usual: they may find it.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "optimization/least_squares/open_variables.h"
#include "optimization/trust_region/noise_check.h"
#include "optimization/trust_region/search_ending.h"
#include "optimization/trust_region/trust_box.h"

namespace latsch {

class FreshSlopes {
 public:
  struct Options {
    double shortest;     // shortest move for slopes, as a share of a width
    double noise_alone;  // see ResidualTrustRegionOptions
    double f_least;      // once the target is below this value, no further round follows
    double f_first;      // value of the target at the start of the search
    /// True: below `f_least` the verification ends as soon as all variables are determined.
    bool asks_what_is_open = false;
    /// Change of the residuals over the moves of the first round, relative to their norm, and
    /// largest number of rounds.
    double change = 1.0;
    int most_rounds = 8;
  };

  /// Begins a verification around the center of the box.
  FreshSlopes(TrustBox& box, const Options& options);

  /// False if the region is a single point.
  bool has_axes() const { return frame_.axes() > 0; }
  /// Returns the next probe or step. Returns nullopt if outcomes of `wanted` must arrive first or,
  /// if `wanted` is empty, if the verification has ended.
  std::optional<Wanted> next(TrustBox& box, const PendingPoints<Wanted>& wanted);
  void observe_failed_step();
  /// Processes a failed probe. `change` is the change of the residuals relative to their size, if
  /// the probe has residuals.
  void observe_failed_probe(double change);
  /// Processes a step. `gain` is the share that it achieved of the gain `promise` that was
  /// predicted; `is_bad` is true if that is almost nothing.
  void observe_step(double gain, bool is_bad, double promise);

  /// Returns the value of the target at the beginning of this round.
  double f_begin() const { return f_begin_; }
  /// True if moves had to be shortened to suit the residuals. The caller then starts no search in a
  /// box from this point.
  bool is_sharp() const { return is_sharp_; }
  /// Valid once the verification has ended.
  Ending ending() const { return ending_; }
  /// Returns what the tests found; valid once the verification has ended.
  const EndingEvidence& evidence() const { return evidence_; }
  /// Returns the noise that the last noisy model has found.
  const ClaimedNoise& noise() const { return noise_; }
  /// Returns the slopes at the center; valid once the verification has ended.
  const PointSlopes& slopes() const { return slopes_; }
  /// Returns the standard deviation of the target that is due to noise.
  double deviation() const { return deviation_; }

 private:
  void begin_round(const TrustBox& box, const Eigen::MatrixXd& J);
  bool is_contradicted() const;
  bool is_doubtful() const;
  std::optional<Wanted> check(const ResidualKriging& m, TrustBox& box);
  void judge_check(const TrustBox& box);
  bool is_wide(const TrustBox& box) const;
  std::optional<Wanted> mirror_weak_axis(const ResidualKriging& m, const TrustBox& box);
  PointSlopes slopes_of(const ResidualKriging& m) const;
  bool leaves_nothing_open(const ResidualKriging& m, const TrustBox& box) const;
  void end(const ResidualKriging& m, const Wanted& step, double noise, const TrustBox& box);
  bool pays_another_round(const TrustBox& box) const;
  void shorten(int axis, double factor);
  bool sharpen(const TrustBox& box);

  /// A trial that shows whether the model is right.
  struct Check {
    Eigen::VectorXd u, r_center, r_expected;
  };

  Options options_;
  NaturalFrame frame_;
  int axis_ = 0;  // index of the next axis to probe
  int rounds_ = 0;
  double change_;            // see Options
  double reach_ = 0.0;       // longest step, in coordinates of the axes
  int steps_ = 0;            // number of steps in this round
  int sharpened_ = 0;        // number of axes shortened in this round
  int mirrored_ = 0;         // index of the next axis that may need a probe to its other side
  bool is_sharp_ = false;    // true if an axis was shortened, in any round
  bool is_blind_ = false;    // true if no slope along some axis of this round is known
  int misses_ = 0;           // number of successive steps that failed or disappointed
  bool has_failed_ = false;  // true if the last step failed
  /// A step of this round gained less than predicted, by more than noise explains.
  bool has_disappointed_ = false;
  /// Largest error of the value predicted for a bad step, as a share of the target, that no later
  /// step of similar promise has outweighed by gaining what was predicted.
  double contradiction_ = 0.0;
  std::optional<Check> check_;    // the check whose outcome is awaited
  int checks_ = 0;                // number of checks in this round
  bool is_unlike_model_ = false;  // true if the last check differed from the model
  bool has_seen_noise_ = false;   // true if a model of any round was noisy
  double deviation_ = 0.0;
  double f_begin_ = 0.0;
  Ending ending_ = Ending::none;
  EndingEvidence evidence_;
  ClaimedNoise noise_;
  PointSlopes slopes_;
};

}  // namespace latsch
