// SPDX-License-Identifier: Apache-2.0
// Determines how well the data determine the variables around a fitted point: confidence intervals,
// and a profile with a verdict for every variable.
//
// Ask and tell, like an optimizer, but in rounds: all points of wanted() may be evaluated at once.
//   1. The derivatives: the center and a step to both sides in each variable (slope_search.h),
//      2n + 1 points, and more if these suggest a better step length. If the model computes its
//      derivatives at the center, the center alone suffices. Then steps along directions with
//      little effect, whose derivatives may be errors of the differences (weak_directions.h).
//   2. A refit of all variables (broyden_fit.h), because the fit may have ended early or may have
//      minimized another target over the same residuals. Without profiles, the refit is made only
//      if the derivatives promise an improvement, and then only for a few steps.
//   3. The profiles, two branches for each variable in parallel (profile.h).
// If any round finds a point better than the center by more than kWorthwhile times the threshold of
// an interval, all rounds start again there, at most most_centers - 1 times: intervals and profiles
// belong to the best point known.
//
//   Identification identification(space, best_point);
//   while (!identification.wanted().empty()) identification.observe(evaluate(wanted()));
//
// If evaluations return derivatives, these are used, also in the refits.
//
// A residual that is NaN in round 1 is not known, for example an unpaired mode, and is left out.
#pragma once

#include <optional>
#include <vector>

#include "base/result.h"
#include "optimization/identifiability/confidence.h"
#include "optimization/identifiability/profile.h"
#include "optimization/identifiability/slope_search.h"
#include "optimization/identifiability/weak_directions.h"

namespace latsch {

/// Options of an identification: noise, differences, and the number of rounds.
struct IdentificationOptions {
  ConfidenceOptions confidence = {};  // noise of the residuals and level of the intervals
  bool profiles = true;               // if false, round 3 is left out
  double step = 0.01;                 // first length of the differences, in the unit cube
  /// Largest number of centers; 1: the given point stays the center.
  int most_centers = 4;
  /// The variables that may move, ascending; empty means all. The others keep their exact values at
  /// every wanted point and have an interval of no width and no profile.
  std::vector<int> free = {};
};

class Identification {
 public:
  /// Begins at a point, usually the best of a search. Throws InputError if the space does not
  /// contain it.
  Identification(const DesignSpace& space,
                 const DesignPoint& point,
                 const IdentificationOptions& options = {});

  /// Returns the points to be evaluated next; empty if the identification has ended.
  const std::vector<DesignPoint>& wanted() const { return wanted_; }
  /// Records the outcomes of the wanted points, in their order; a Failure if an evaluation failed.
  /// `evaluated` may hold only the first outcome if is_enough() is true for it.
  void observe(const std::vector<Result<Evaluated>>& evaluated);
  /// True if the outcome of the first wanted point makes the others needless: it is the center and
  /// contains the model's derivatives.
  bool is_enough(const Result<Evaluated>& first) const {
    return !r_ && first && first->has_slopes();
  }

  /// Returns the reason if round 1 was impossible.
  const Status& status() const { return status_; }
  /// Returns the point to which linearization, confidence and profiles belong: the given point, or
  /// a better one found since then.
  const DesignPoint& center() const { return center_; }
  /// Returns the quality of the derivatives, one entry for each variable.
  const std::vector<SlopeQuality>& slopes() const { return qualities_; }
  /// Returns directions of the unit cube along which the differences contain nothing but their own
  /// errors.
  const std::vector<Eigen::VectorXd>& unknown_directions() const { return unknown_; }
  /// Returns the step lengths of the differences, one for each variable, in the unit cube.
  const Eigen::VectorXd& lengths() const { return lengths_; }
  /// One term of the derivative with respect to a variable, which is the sum of weight * value over
  /// trials. The same sum gives the derivative of any other quantity of the trials. The list of
  /// terms is empty if the model computed its derivatives.
  struct Term {
    DesignPoint point;  // point of a trial
    double weight;      // factor of the trial's value
  };
  /// Returns the terms of the derivative with respect to this variable of the unit cube.
  std::vector<Term> derivative(int variable) const;
  /// True if linearization and confidence exist: not before round 1 is done, nor while it is
  /// repeated at a better point.
  bool is_linearized() const { return at_.has_value(); }
  /// True if the wanted points are those of profiles. If refitted() is exact, their outcomes may
  /// then be passed as reduced_rows() with all used residuals in one group.
  bool is_profiling() const { return !branches_.empty() && !wanted_.empty(); }
  /// Purpose of the wanted points.
  enum class Phase { derivatives, refit, profiles };
  /// Returns the phase of the wanted points.
  Phase phase() const;
  /// Returns the estimated number of evaluations to come in this and all later phases, from usual
  /// numbers of evaluations for each variable. A better point that starts all phases again, and
  /// profiles along narrow valleys, take more.
  long expected_left() const;
  /// Returns the share of the steps of all profiles that is done, estimated from the remaining
  /// length of each profile. Steps that are halved or repeated are not included.
  double share_done() const;
  /// Residuals and derivatives at the center.
  const Linearization& linearization() const { return *at_; }
  /// Intervals, correlations and directions, from the linearization.
  const Confidence& confidence() const { return *confidence_; }
  /// Returns the indices of the residuals that are used.
  const std::vector<Eigen::Index>& residuals_used() const { return rows_; }
  /// Returns the linearization at the least sum of squares, after round 2.
  const Linearization& refitted() const { return *best_; }
  /// Returns one profile for each variable that may move, if profiles are requested and complete.
  const std::vector<TargetProfile>& profiles() const { return profiles_; }

 private:
  void begin_at(const DesignPoint& center);
  void slopes_observed(const std::vector<Result<Evaluated>>& evaluated);
  Status center_observed(const std::vector<Result<Evaluated>>& evaluated);
  void ask_slopes();
  void take_slopes();
  void linearized(Linearization at);
  bool ask_weak_directions();
  void weak_directions_observed(const std::vector<Result<Evaluated>>& evaluated);
  void after_slopes();
  double felt() const;
  double worthwhile() const;
  void look_for_better(const std::vector<Result<Evaluated>>& evaluated);
  bool continues_at_better_point();
  DesignPoint moved(int variable, double offset) const;
  Eigen::VectorXd way(int variable, double& scale) const;
  DesignPoint held_at_center(const Eigen::VectorXd& u) const;
  Confidence confidence_of_free(const Linearization& at) const;
  void refit_observed(const std::optional<Evaluated>& evaluated);
  void ask_for_refit();
  void begin_profiles();
  void ask_branches();
  std::optional<Evaluated> used(const Result<Evaluated>& evaluated) const;

  DesignSpace space_;
  IdentificationOptions options_;
  std::vector<int> free_;  // indices of the variables that may move
  DesignPoint center_;
  int centers_ = 1;
  std::vector<DesignPoint> wanted_;
  Status status_;
  std::vector<SlopeSearch> searches_;  // one a variable
  /// Index in searches_ of each point of wanted_ except the center.
  std::vector<int> owners_;
  std::optional<Eigen::VectorXd> r_;  // the used residuals at the center
  Eigen::VectorXd scale_;             // standard deviations of the used residuals
  /// Projector onto the motions that linear equations allow the free variables; empty if there is
  /// no equation.
  Eigen::MatrixXd ways_;
  std::vector<SlopeQuality> qualities_;
  Eigen::VectorXd lengths_;
  double least_ = 0.0;  // sum of squares of the best point evaluated
  DesignPoint least_point_;
  std::vector<Eigen::Index> rows_;
  std::optional<Linearization> at_, best_;
  std::optional<Confidence> confidence_;
  Differences made_;  // lengths and errors of the differences from which J was computed
  std::optional<WeakDirections> weak_;
  int weak_rounds_ = 0;
  std::vector<Eigen::VectorXd> unknown_;
  std::optional<BroydenFit> refit_;
  std::vector<ProfileBranch> branches_;  // downward and upward branch of each variable
  /// Indices of the branches that requested the points of wanted_.
  std::vector<int> asked_;
  std::vector<TargetProfile> profiles_;
  std::vector<double> thresholds_;  // one a variable
};

}  // namespace latsch
