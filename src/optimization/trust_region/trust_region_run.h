// SPDX-License-Identifier: Apache-2.0
// One run of the residual trust region from one start, with its restarts: the method of
// residual_trust_region.h without the search for lost variables, which lost_variable_trials.h adds.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>

#include "optimization/trust_region/fresh_slopes.h"
#include "optimization/trust_region/residual_trust_region.h"
#include "optimization/trust_region/search_ending.h"
#include "optimization/trust_region/trust_box.h"
#include "optimization/trust_region/trust_radius.h"
#include "optimization/trust_region/trust_region_tuning.h"
#include "optimization/trust_region/trust_restarts.h"

namespace latsch {

class TrustRegionRun {
 public:
  /// Starts from the initial values of the space.
  TrustRegionRun(const DesignSpace& space,
                 const ResidualTrustRegionOptions& options,
                 const TrustRegionTuning& tuning = {});

  /// Returns the wanted points in the order proposed; empty: ended or settled.
  const PendingPoints<Wanted>& wanted() const { return wanted_; }
  /// Receives the outcome of a point; `sample` is empty for a failure. `u` is its position, which
  /// is outside of the unit cube for a point from another source that lies outside of the bounds.
  void observe(const DesignPoint& point,
               const Eigen::VectorXd& u,
               const std::optional<ResidualSample>& sample);

  /// True if the run has settled: it is about to restart, its best value is clearly better than
  /// when it last settled, and it waits for go_on().
  bool has_settled() const { return state_ == State::settled; }
  /// Returns the ending of the search that led to the best point.
  Ending ending() const { return is_hopeless() ? Ending::hopeless : ending_; }
  /// True if the noise of the measured values is known and explains the whole remaining error.
  bool is_down_to_noise() const { return box_.is_down_to(options_.noise_alone); }
  int restarts_left() const { return options_.restarts - restarts_.count(); }
  void go_on(int restarts_left);
  /// Sets the number of points proposed at a time from now on.
  void widen(int count);

  const ResidualTrustRegionOptions& options() const { return options_; }
  TrustBox& box() { return box_; }
  const TrustBox& box() const { return box_; }
  /// Returns the best sample. Requires that a point has succeeded.
  const ResidualSample& best() const { return box_.memory[box_.best()]; }

 private:
  enum class State {
    searching,
    settled,  // waits for a call of go_on()
    over      // the last restart has failed
  };
  struct OpenDirection {
    double share = 0.0;  // share of the variance of the direction's slope that samples leave
    Eigen::VectorXd direction;
  };

  int n() const { return box_.n(); }
  /// Value below which nothing is left to gain.
  double nothing_left() const { return tuning_.search.nothing_left * f_first_; }
  double settled_radius() const { return tuning_.search.settled * options_.initial_radius; }
  bool is_hopeless() const;
  // Chooses the next points: of the search in the box, of the verification at its end, or of a
  // restart.
  void fill();
  std::optional<Wanted> next();
  std::optional<Wanted> next_of_search();
  OpenDirection open_direction() const;
  std::optional<Wanted> probe(const OpenDirection& open, double least_share) const;
  bool is_step_awaited() const;
  std::optional<Wanted> another_step(const ResidualKriging& m);
  std::optional<Wanted> look_around();
  bool begin_verification();
  std::optional<Wanted> next_to_verify();
  std::optional<Wanted> restart();
  void start_again(const Eigen::VectorXd& failed);
  // Processes the outcome of a point of this run.
  void take(const Wanted& tried, ResidualSample sample);
  void take_failure(const Wanted& tried, const std::optional<ResidualSample>& exploded);
  double change_of(const std::optional<ResidualSample>& sample) const;
  void judge_verifying_step(double gain, double promise);

  ResidualTrustRegionOptions options_;
  TrustRegionTuning tuning_;
  TrustBox box_;
  TrustRadius radius_;
  TrustRestarts restarts_;
  std::optional<FreshSlopes> verification_;  // set at the end of a search
  State state_ = State::searching;
  Ending ending_ = Ending::known;
  /// The value at the start or, if the start failed, at the first success.
  double f_first_ = std::numeric_limits<double>::infinity();
  /// Values below this one are verified.
  double f_verified_ = std::numeric_limits<double>::infinity();
  /// Number of random points proposed at the end of a run since its last improvement.
  int explored_ = 0;
  PendingPoints<Wanted> wanted_;
};

}  // namespace latsch
