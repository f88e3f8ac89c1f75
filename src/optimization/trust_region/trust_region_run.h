// SPDX-License-Identifier: Apache-2.0
// One run of the residual trust region from one start, with its restarts: the method of
// residual_trust_region.h without the search for lost variables, which happens between runs.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>

#include "optimization/trust_region/fresh_slopes.h"
#include "optimization/trust_region/residual_trust_region.h"
#include "optimization/trust_region/search_ending.h"
#include "optimization/trust_region/trust_box.h"

namespace latsch {

class TrustRegionRun {
 public:
  /// Starts from the initial values of the space.
  TrustRegionRun(const DesignSpace& space, const ResidualTrustRegionOptions& options);

  /// Returns the wanted points in the order proposed; empty: ended or settled.
  const PendingPoints<Wanted>& wanted() const { return wanted_; }
  /// Receives the outcome of a point; `sample` is empty for a failure. `u` is its position, which
  /// is outside of the unit cube for a point from another source that lies outside of the bounds.
  void observe(const DesignPoint& point,
               const Eigen::VectorXd& u,
               const std::optional<ResidualSample>& sample);

  /// True before a restart from a value clearly better than at the last time: the run waits for
  /// `go_on`.
  bool has_settled() const { return has_settled_; }
  /// Returns the ending of the search that led to the best point.
  Ending ending() const { return is_hopeless() ? Ending::hopeless : ending_; }
  /// True if the noise of the measured values is known and explains the whole remaining error.
  bool is_down_to_noise() const { return box_.is_down_to(options_.noise_alone); }
  int restarts_left() const { return options_.restarts - restarts_; }
  void go_on(int restarts_left);
  /// Sets the number of points proposed at a time from now on.
  void widen(int count);

  const ResidualTrustRegionOptions& options() const { return options_; }
  TrustBox& box() { return box_; }
  const TrustBox& box() const { return box_; }
  /// Requires that a point has succeeded.
  const ResidualSample& best() const { return box_.memory[box_.best()]; }

 private:
  struct OpenDirection {
    double share = 0.0;  // share of the variance of its slope
    Eigen::VectorXd direction;
  };

  int n() const { return box_.n(); }
  // Chooses the next points: a search in the box, verification at its end, restarts.
  void fill();
  std::optional<Wanted> next();
  std::optional<Wanted> next_of_search();
  OpenDirection open_direction() const;
  bool is_step_awaited() const;
  std::optional<Wanted> another_step(const ResidualKriging& m);
  bool widen_in_noise();
  std::optional<Wanted> look_around();
  bool begin_verification();
  std::optional<Wanted> next_to_verify();
  std::optional<Wanted> restart();
  std::optional<Wanted> release();
  Wanted start();
  void start_again(const Eigen::VectorXd& failed);
  bool is_hopeless() const;
  // Updates the box with an outcome.
  void take(const Wanted& tried, ResidualSample sample);
  void take_failure(const Wanted& tried, const std::optional<ResidualSample>& exploded);
  double change_of(const std::optional<ResidualSample>& sample) const;
  void judge_verifying_step(double gain, double promise);

  ResidualTrustRegionOptions options_;
  TrustBox box_;
  std::optional<FreshSlopes> verification_;  // present at the end of a search
  Ending ending_ = Ending::known;
  // Increase of f at an initial radius off the best point, from the last time it was the center.
  double rise_ = 0.0;
  double f_first_ = std::numeric_limits<double>::infinity();     // at the start, or first success
  double f_verified_ = std::numeric_limits<double>::infinity();  // lower values are verified
  bool is_geometry_doubted_ = false;                             // a step disappointed
  bool has_widened_ = false;  // widened the radius for noise since the last outcome
  int disappointments_ = 0;   // number in a row
  int failures_ = 0;          // number in a row
  int explored_ = 0;          // number of points at the end of a run since its last better one
  int widenings_ = 0;         // number of widenings of the radius, for a search at noise level
  int restarts_ = 0;
  Eigen::MatrixXd flat_;      // directions without effect at the best point of all
  int scouts_ = 0;            // number of points along these directions left in this restart
  bool is_scouting_ = false;  // the start being evaluated is a scout
  bool is_over_ = false;      // the last restart failed
  bool has_settled_ = false;
  double f_settled_ = std::numeric_limits<double>::infinity();   // best value when the run settled
  double f_released_ = std::numeric_limits<double>::infinity();  // best value at the last release
  PendingPoints<Wanted> wanted_;
};

}  // namespace latsch
