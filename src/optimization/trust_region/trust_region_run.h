// SPDX-License-Identifier: Apache-2.0
// One run of the residual trust region from one start, with its restarts: the method of
// residual_trust_region.h without the search for lost variables, which lost_variable_trials.h adds.
//
// When nothing is left to try, the run returns to its best point for the trials that show what may
// be said of this end (trust_region_end.cpp). They come after all others, so the search does not
// depend on them; if one of them finds a better point, the search goes on from there.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <vector>

#include "optimization/trust_region/ending_trials.h"
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
  /// Returns what the tests of this ending found.
  EndingEvidence evidence() const;
  int restarts_left() const { return options_.restarts - restarts_.count(); }
  void go_on(int restarts_left);
  /// Says whether this run tests its end. Trial runs, whose ends are not reported, do not.
  void set_tests_end(bool tests_end) { tests_end_ = tests_end; }
  bool tests_end() const { return tests_end_; }
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
    over,     // the last restart has failed
    ending    // the search is over; its end is tested
  };
  struct OpenDirection {
    double share = 0.0;  // share of the variance of the direction's slope that samples leave
    Eigen::VectorXd direction;
  };

  int n() const { return box_.n(); }
  /// Value below which nothing is left to gain.
  double nothing_left() const { return tuning_.search.nothing_left * f_first_; }
  /// Returns that value at the end of the run, by the scale of the data if it is known.
  double nothing_left_at_end() const;
  double settled_radius() const { return tuning_.search.settled * options_.initial_radius; }
  bool is_hopeless() const;
  // Chooses the next points: of the search in the box, of the verification at its end, or of a
  // restart.
  void fill();
  std::optional<Wanted> next();
  std::optional<Wanted> next_of_run();
  std::optional<Wanted> next_of_search();
  OpenDirection open_direction() const;
  std::optional<Wanted> probe(const OpenDirection& open, double least_share) const;
  bool is_step_awaited() const;
  std::optional<Wanted> another_step(const ResidualKriging& m);
  std::optional<Wanted> look_around();
  bool begin_verification();
  FreshSlopes::Options verification_options() const;
  std::optional<Wanted> next_to_verify();
  void take_ending();
  void forget_ending(Ending ending);
  // The tests of the end.
  std::optional<Wanted> next_at_end();
  bool begin_end();
  bool begin_fresh_slopes();
  bool begin_noise_check();
  bool begin_shorter_slopes();
  bool begin_ending_trials();
  std::optional<Wanted> look_for_ridge();
  void judge_ridge(const Eigen::VectorXd& r);
  void go_on_searching();
  void observe_at_end(const Wanted& tried, const std::optional<Eigen::VectorXd>& r);
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
  /// Findings of the last verification of a best point, its slopes, and the sample at which it
  /// ended; -1: there is none.
  EndingEvidence evidence_;
  PointSlopes slopes_;
  int slopes_at_ = -1;
  bool tests_end_ = true;
  ClaimedNoise noise_;                     // noise that this verification has found
  std::optional<NoiseCheck> noise_check_;  // set while this noise is checked
  int noise_checked_ = -1;                 // best sample whose noise has been checked; -1: none
  bool is_shorter_ = false;                // true while slopes are recomputed over shorter moves
  std::optional<EndingTrials> ending_trials_;  // set while the end is tested
  int tested_ = -1;                            // best sample whose end has been tested; -1: none
  int returns_ = 0;          // number of times that the search went on from a better point
  std::vector<int> ends_;    // samples at which searches of this run ended
  int other_end_ = -1;       // the end that is compared with the best point; -1: none
  Eigen::VectorXd between_;  // the point between them
  int compared_ = -1;        // best sample that has been compared with another end
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
