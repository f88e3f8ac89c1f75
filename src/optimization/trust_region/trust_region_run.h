// SPDX-License-Identifier: Apache-2.0
// One run of the residual trust region from one start, with its restarts: the method as
// residual_trust_region.h describes it, but for lost variables, which are looked for between runs.
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
  /// From the initial values of the space.
  TrustRegionRun(const DesignSpace& space, const ResidualTrustRegionOptions& options);

  /// In the order proposed; empty: ended, or it has settled.
  const PendingPoints<Wanted>& wanted() const { return wanted_; }
  /// `sample`: none for a failure.
  /// `u`: its place, outside of the unit cube for a foreign point outside of the bounds.
  void observe(const DesignPoint& point,
               const Eigen::VectorXd& u,
               const std::optional<ResidualSample>& sample);

  /// Before a restart from a value clearly better than at the last time: it waits for `go_on`.
  bool has_settled() const { return has_settled_; }
  /// Of the search that led to the best point.
  Ending ending() const { return is_hopeless() ? Ending::hopeless : ending_; }
  /// Nothing is left that the noise of the measured values, where it is known, does not explain.
  bool is_down_to_noise() const { return box_.is_down_to(options_.noise_alone); }
  int restarts_left() const { return options_.restarts - restarts_; }
  void go_on(int restarts_left);
  /// Wants `count` points at a time from here on.
  void widen(int count);

  const ResidualTrustRegionOptions& options() const { return options_; }
  TrustBox& box() { return box_; }
  const TrustBox& box() const { return box_; }
  /// Requires that a point succeeded.
  const ResidualSample& best() const { return box_.memory[box_.best()]; }

 private:
  struct OpenDirection {
    double share = 0.0;  // of the variance of its slope
    Eigen::VectorXd direction;
  };

  int n() const { return box_.n(); }
  // What to ask next: a search in the box, verified at its end, started again.
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
  // What an outcome makes of the box.
  void take(const Wanted& tried, ResidualSample sample);
  void take_failure(const Wanted& tried, const std::optional<ResidualSample>& exploded);
  double change_of(const std::optional<ResidualSample>& sample) const;
  void judge_verifying_step(double gain, double promise);

  ResidualTrustRegionOptions options_;
  TrustBox box_;
  std::optional<FreshSlopes> verification_;  // at the end of a search
  Ending ending_ = Ending::known;
  double rise_ = 0.0;  // of f, an initial radius off the best point, when it last was the center
  double f_first_ = std::numeric_limits<double>::infinity();  // of the start, or the first success
  double f_verified_ = std::numeric_limits<double>::infinity();  // from below it one more pays
  bool is_geometry_doubted_ = false;                             // a step disappointed
  bool has_widened_ = false;  // the radius, for noise, since the last outcome
  int disappointments_ = 0;   // in a row
  int failures_ = 0;          // in a row
  int explored_ = 0;          // points at the end of a run, since its last better one
  int widenings_ = 0;         // of the radius, at the end of a search in the noise
  int restarts_ = 0;
  Eigen::MatrixXd flat_;      // directions without effect at the best point of all
  int scouts_ = 0;            // along them, left of this restart
  bool is_scouting_ = false;  // the start under way is one
  bool is_over_ = false;      // the last restart failed
  bool has_settled_ = false;
  double f_settled_ = std::numeric_limits<double>::infinity();   // the best value when it last had
  double f_released_ = std::numeric_limits<double>::infinity();  // the best when bounds were left
  PendingPoints<Wanted> wanted_;
};

}  // namespace latsch
