// SPDX-License-Identifier: Apache-2.0
// Profile likelihood determines how well the data can still be explained if one variable is held at
// another value and all others are refitted.
//
//   S_i(v) = least sum of squares with u_i = v
//                                         [Raue et al., Bioinformatics 25 (2009) 1923, eq. (5)]
// All v with S_i(v) - S <= threshold belong to the confidence interval of variable i. The threshold
// is s^2 t^2 for independent residuals and Confidence::thresholds in general. Unlike the linear
// interval, the profile includes curvature, bounds and further minima. The verdict follows from its
// shape:
//   identifiable     S_i rises above the threshold on both sides
//   one_sided        S_i rises above it on one side only: the data give a limit, not a value
//   flat             S_i rises on no side: any value between the bounds explains the data as well
//   several_minima   S_i rises and falls again: a search can end in the wrong minimum
//   not_evaluable    the model fails before S_i rises: nothing is known about values beyond
//
// The variable is moved from the best point in steps (rungs of a ladder), first as long as the
// linear interval, then growing to a tenth of the range, up to both bounds. A step that exceeds the
// threshold by far is halved, and so is one at which the model fails. Derivatives carried from step
// to step miss changes in other directions, so a quarter of them is recomputed at each step, and
// all of them at the step that rises above the threshold. At each step the other variables are
// refitted, starting where the last refit ended. A refit may miss a better minimum of the other
// variables, so S_i is an upper bound. If S_i falls outward, the steps before the fall are
// therefore refitted from the outer side, and a rise that disappears does not count. A refit that
// did not converge does not count as a rise either. Linear constraints are satisfied and end a
// profile as bounds do.
#pragma once

#include <string>
#include <vector>

#include "optimization/identifiability/broyden_fit.h"

namespace latsch {

/// One point of a profile, at which all other variables are refitted.
struct ProfilePoint {
  Eigen::VectorXd u;      // point of the unit cube
  double S;               // least sum of squares with this value of the variable
  bool converged = true;  // true if the refit of the other variables converged
};

/// Settings that the branches of all variables share.
struct ProfileSettings {
  FeasibleRegion region;        // bounds and linear constraints
  Eigen::VectorXd differences;  // see BroydenFitOptions
  std::vector<int> free = {};   // the variables that may move, ascending; empty: all
};

/// The profile on one side of the best point. Its caller asks for points and reports outcomes, as
/// with BroydenFit.
class ProfileBranch {
 public:
  /// `half` is half the width of the linear confidence interval. `direction` is +1 or -1.
  ProfileBranch(const Linearization& best,
                int variable,
                int direction,
                double half,
                double threshold,
                const ProfileSettings& settings);

  /// Returns the next point to evaluate; nullopt at the end of the branch.
  std::optional<Eigen::VectorXd> wanted() const;
  /// Receives the outcome of the wanted point; nullopt if the evaluation failed.
  void observe(const std::optional<Evaluated>& evaluated);

  /// Returns the points from the best point outward, without the best point.
  const std::vector<ProfilePoint>& points() const { return points_; }
  /// Returns the expected number of steps to the end of the branch, if no step fails, is halved or
  /// is repeated; 0 if the branch has ended.
  int rungs_left() const;
  /// Returns the value of the variable nearest to the start at which the model failed; nullopt if
  /// it never failed.
  const std::optional<double>& failed_at() const { return failed_at_; }

 private:
  struct Bracket {
    Linearization inner, outer;  // results at a point below the threshold and at one far above it
    /// Value of the variable at the nearest point known to be above the threshold.
    double upper;
    int halvings = 0;
  };

  /// The steps before a fall of S, which are being refitted from the outer side.
  struct Return {
    /// The point from which the branch continues outward afterward.
    Linearization outer;
    int place;  // index in points_ of the point being refitted
  };

  void next_rung(const Linearization& from);
  double rung_after(double at, double length) const;
  void climb(const Linearization& from, double to);
  void halve();
  void rung_reached(const Linearization& reached);
  bool verifies(const Linearization& reached);
  void rung_failed(double at);
  void return_observed(const std::optional<Linearization>& reached);
  bool returns_from(const Linearization& reached, int place);
  double tolerance(double S) const;
  BroydenFitOptions rung_options(double S, const std::vector<int>& refresh) const;
  std::vector<int> next_columns();
  bool within(const Linearization& at) const { return at.sum_of_squares() - least_ <= threshold_; }
  bool leaps(const Linearization& from, const Linearization& to) const;
  int insert(const Linearization& reached, bool converged);

  int variable_, direction_;
  double length_, threshold_, least_;
  ProfileSettings settings_;
  double end_;       // the last value of the variable inside the region
  double to_ = 0.0;  // the variable's value in the present refit
  int steps_to_the_edge_ = 0, returns_ = 0;
  std::optional<double> failed_at_;
  std::optional<Return> return_;
  bool verifying_ = false;
  size_t next_column_ = 0;  // index in free_ of the next column to recompute
  std::vector<int> free_;
  Linearization last_;  // the last point of the branch
  std::optional<Bracket> bracket_;
  std::optional<BroydenFit> refit_;
  std::vector<ProfilePoint> points_;
};

/// Verdict on a variable by its profile.
enum class Verdict { identifiable, one_sided, flat, several_minima, not_evaluable };

/// The profile of one variable: the least sum of squares as a function of it.
struct TargetProfile {
  int variable = 0;  // index
  /// Points of the profile in ascending order of the variable, including the best point.
  std::vector<ProfilePoint> points;
  double least = 0.0;      // the least S, from which the growth of S is measured
  double threshold = 0.0;  // growth of S at the ends of the interval
  /// The ends at which S - least crosses the threshold; infinite where it does not.
  Interval interval{};
  Verdict verdict = Verdict::flat;  // in one word
  std::vector<int> other_minima;    // indices in `points` of minima other than the best point
  /// The last evaluated value on a side where the model fails before S has exceeded the threshold.
  std::optional<double> lower_end = std::nullopt, upper_end = std::nullopt;

  /// Returns the number of points whose refit did not converge: S is too high there, and the
  /// interval may be wider.
  int unconverged() const;
};

/// Joins the two branches of a variable and gives the verdict.
TargetProfile judge(const Linearization& best,
                    int variable,
                    const ProfileBranch& down,
                    const ProfileBranch& up,
                    double threshold);

/// Returns "identifiable", "one-sided", "flat", "several minima" or "not evaluable beyond".
std::string name(Verdict verdict);
/// Returns the verdict as a sentence: "one-sided: the data give only an upper limit".
std::string in_words(const TargetProfile& profile);

}  // namespace latsch
