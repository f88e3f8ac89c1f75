// SPDX-License-Identifier: Apache-2.0
// Determines how well the data determine the variables at a fitted point, from the residuals and
// their derivatives alone.
//
// The residuals r(u) of m measured values, each divided by its noise or weighted equally, depend on
// n variables u of the unit cube. J = dr/du is taken at, or near, the least sum of squares S = r'
// r. In linear approximation,
//   s^2 V                               covariance of the residuals (residual_noise.h); V = 1 and
//                                       s^2 = S / (m - n) if they are alike and independent
//   C = s^2 (J' J)^-1 J' V J (J' J)^-1  covariance of the variables
//   u_i +- (t sqrt(C_ii) + |d_i|)       confidence interval, t of Student's distribution
//   d = -(J' J)^-1 J' r                 remaining distance from u to the least S
// [Bard, Nonlinear Parameter Estimation, 1974, ch. 7; Seber, Wild, Nonlinear Regression, 1989, ch.
// 5]
//
// The singular values of J show how strongly the data determine the directions of the unit cube:
// along direction v_k the standard deviation is s / sigma_k. If s / sigma_k exceeds the range
// itself, the data determine nothing along v_k. A variable at a bound is held there if S falls
// toward the bound, and all other intervals hold for this value of it. Its interval is one-sided:
// it contains the values u_i for which S, minimized over the other variables, exceeds the least S
// by at most a threshold. The threshold is the excess of S at the ends of a two-sided interval: s^2
// t^2 if the residuals are alike and independent. The part of the residuals that a held variable
// would explain if it were released is not noise, so s is estimated from the part that no variable
// can explain. If the held variables explain the larger part of S, the rest, too, contains the
// curvature of the model and is a pattern rather than noise.
//
// In a fit without noise, of a model to its own results, only rounding errors of the simulations
// are left: less than `least_noise`, or less than a thousandth of the stated noise. For such
// residuals V = 1, and a variable counts as held by its bound only if it would leave the bound by
// more than the rounding errors explain. The intervals then follow from J alone, wherever the
// search began.
//
// If s is stated and the residuals are larger than it explains (chance of one in a thousand),
// either the model cannot reproduce the measurement or the search has ended early. The intervals
// then use the observed spread, and `excess` is its ratio to the stated one.
//
// For residuals with a robust loss (robust_loss.h), C is replaced by the covariance of M-estimation
// (robust_rows.h), and J'J by A: the curvature of S is lower beyond the corner of a loss, and a
// value there moves the fit no more than one at the corner. The thresholds are the growth of S at
// the ends of these intervals, t^2 C_ii / (A^-1)_ii, so that profiles agree. The degrees of freedom
// are m - n as without a loss. If the noise is stated, `excess` is not computed: values beyond the
// corner are counted and widen the intervals. If psi' is 1 for all values, everything is as without
// a loss.
//
// The result is exact for linear models and Gaussian noise without a loss; otherwise a profile
// (profile.h) is more reliable. The interval is that of the fit that minimizes S.
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <vector>

#include "optimization/identifiability/equal_plane.h"
#include "optimization/identifiability/residual_noise.h"
#include "optimization/problem/design_space.h"
#include "optimization/region/generating_set.h"

namespace latsch {

/// Result of an evaluation: residuals, and dr/du if the model computes its slopes.
struct Evaluated {
  /// Holds the residuals and, if the model computes them, their derivatives.
  Evaluated(Eigen::VectorXd residuals, Eigen::MatrixXd slopes = {})
      : r(std::move(residuals)), J(std::move(slopes)) {}

  /// True if the model computed dr/du.
  bool has_slopes() const { return J.size() > 0; }
  /// Returns the residuals and derivatives of the given rows only.
  Evaluated of(const std::vector<Eigen::Index>& rows) const {
    return {r(rows), has_slopes() ? Eigen::MatrixXd(J(rows, Eigen::all)) : Eigen::MatrixXd()};
  }

  Eigen::VectorXd r;        // m residuals
  Eigen::MatrixXd J;        // m x n derivatives; empty: not known
  bool is_reduced = false;  // true if the rows are reduced rows (reduced_rows.h)
};

/// Residuals and their derivatives at a point of the unit cube.
struct Linearization {
  Eigen::VectorXd u;      // n
  Eigen::VectorXd r;      // m
  Eigen::MatrixXd J;      // m x n
  bool is_exact = false;  // true if J was computed by the model, not by differences

  /// Returns S = r'r.
  double sum_of_squares() const { return r.squaredNorm(); }
};

/// Noise of the residuals and level of the intervals.
struct ConfidenceOptions {
  std::optional<double> sigma = std::nullopt;  // standard deviation of a residual, if known
  double level = 0.95;  // probability that an interval contains the true value
  /// Smallest standard deviation used if the spread is estimated, because no residual is computed
  /// more exactly. It prevents intervals of zero width if a model is fitted to its own results.
  double least_sigma = 1e-9;
  /// If the spread is estimated and is smaller than this value, it counts as rounding errors of the
  /// simulations and not as noise, so correlation of neighbors is not estimated. The unit is that
  /// of the residuals: for relative differences, 1e-5 is less than the noise of any laboratory.
  double least_noise = 1e-9;
  ResidualTraits traits = {};  // groups and order of the residuals, for noise that neighbors share
  /// Plane in which linear equations between the variables keep the fit.
  EqualPlane plane = {};
};

/// The two ends of an interval in the unit cube. They may lie outside of the cube, and are infinite
/// if nothing determines the variable.
struct Interval {
  double lower, upper;  // coordinates in the unit cube
};

/// Uncertainty of the variables that are not held by a bound, along orthogonal directions. The
/// uncertainty of values computed from the variables follows from it (prediction_band.h).
struct FreeDirections {
  Eigen::MatrixXd axes;        // n x f: the columns are directions; rows of held variables are 0
  Eigen::MatrixXd covariance;  // f x f: covariance of the coordinates along the directions
  /// Distance to the minimum of S along each of the f directions; 0 if no residual depends on it.
  Eigen::VectorXd left;
  /// f x n: motion along each direction for a unit motion of a held variable, if the free variables
  /// are refitted.
  Eigen::MatrixXd following;
  /// n x n: motion of the free variables that keeps linear equations for a unit motion of a held
  /// variable; empty if there are no equations.
  Eigen::MatrixXd kept;
  double t = 0.0;  // largest quantile t that an interval of a variable uses
};

struct Confidence {
  /// Standard deviation of a residual or, if losses limit residuals and no noise is stated, of its
  /// psi; NaN unless there are more residuals than variables.
  double sigma;
  double t;                         // Student's quantile, two-sided, of independent residuals
  std::vector<Bound> held;          // variables whose bound prevents a better fit
  Eigen::VectorXd singular_values;  // descending, of all variables: of J, or of the root of A
  /// Each column is a direction of the unit cube. There are fewer than variables if linear
  /// equations between these keep the fit in a plane.
  Eigen::MatrixXd directions;
  /// Covariance of the n variables; rows and columns of held ones are 0.
  Eigen::MatrixXd covariance;
  /// Correlation of the n variables; rows and columns of held ones are 0.
  Eigen::MatrixXd correlation;
  std::vector<Interval> intervals;  // one for each variable
  /// For each variable, the excess of S over the least S up to which values belong to its interval.
  std::vector<double> thresholds;
  /// Standard deviation along each direction, as a share of the ranges of the variables; infinite
  /// if no residual depends on the direction.
  Eigen::VectorXd direction_deviations;
  /// Standard deviation of every residual as it acts on the variables, including the part it shares
  /// with its neighbors.
  Eigen::VectorXd noise;
  /// Ratio of the observed spread of the residuals to the stated one, if chance cannot explain that
  /// it is larger; 1 otherwise.
  double excess = 1.0;
  bool is_colored = false;  // true if neighbors share noise
  /// Number of neighbors that count as one independent value if neighbors share noise.
  double samples_for_one = 1.0;
  /// True if the residuals are a smooth pattern, a misfit of the model and not noise: the intervals
  /// follow from their spread (residual_noise.h).
  bool is_pattern = false;
  /// For each group of residuals whose spread is estimated, by its number, the values that are left
  /// beside those that the fit uses up (group_spreads.h).
  std::map<int, double> group_freedoms;
  /// Share of the sum of squares that would vanish, by J, if the held variables were released.
  double share_beyond_bounds = 0.0;
  double left_to_gain = 0.0;  // S minus the least S that J predicts with held variables fixed
  int with_loss = 0;          // number of residuals with a robust loss
  int beyond = 0;             // number of residuals beyond the corner of their loss
  /// Expected share of the residuals with a loss that Gaussian noise of the stated size leaves
  /// beyond the corner.
  double expected_beyond = 0.0;
  /// For each residual, the share of a change of it that moves the minimum of S; empty if all
  /// shares are 1.
  Eigen::VectorXd felt_changes;
  FreeDirections free;  // directions of the variables that no bound holds
  EqualPlane plane;     // plane in which linear equations keep all variables

  /// Returns s^2 t^2, the threshold for independent residuals.
  double threshold() const { return sigma * sigma * t * t; }
  /// Returns the standard deviation along direction k, as a share of the ranges of the variables;
  /// infinite if no residual depends on the direction.
  double deviation(int k) const { return direction_deviations[k]; }
};

/// Returns a bound for the sum of squares of nu standard normal numbers, divided by nu, that is
/// exceeded with a chance of one in a thousand [Wilson, Hilferty, Proc. Nat. Acad. Sci. 17 (1931)
/// 684].
double rare_ratio(double nu);

/// Computes the confidence at a point. There must be at least one residual.
Confidence confidence(const Linearization& at, const ConfidenceOptions& options = {});

/// Extends the confidence of the free variables to all variables. The other variables stay at `u`:
/// their intervals have no width, their covariance is zero, and no direction contains them. The
/// number of directions is that of the free variables.
Confidence of_all_variables(Confidence part,
                            const std::vector<int>& free,
                            const Eigen::VectorXd& u);

/// Returns the shift of the minimum of S, -(J'J)^-1 J' change in the variables that are not held,
/// if all residuals change by `change`. This is the shift of the fitted values for a model whose
/// results differ by `change`. It is 0 in held variables and along directions that no residual
/// depends on. `felt_changes` is the member of the confidence; if it is not empty, it enters J'J
/// and J' as weights. The shift stays in the plane.
Eigen::VectorXd shift_of(const Linearization& at,
                         const std::vector<Bound>& held,
                         const Eigen::VectorXd& change,
                         const Eigen::VectorXd& felt_changes = {},
                         const EqualPlane& plane = {});

/// Returns the points from which J is computed by differences: the center, then one point for each
/// variable of the unit cube, moved up by its step, or down if the step would lead beyond the upper
/// bound. If linear constraints forbid this point but not the opposite one, the opposite one is
/// used. `steps` has one entry for each variable; 0 or an empty vector means 0.01.
std::vector<DesignPoint> difference_points(const DesignSpace& space,
                                           const DesignPoint& center,
                                           const Eigen::VectorXd& steps = {});

/// Returns the indices of the residuals that are known, not NaN, at all points.
std::vector<Eigen::Index> known_residuals(const std::vector<Eigen::VectorXd>& residuals);

/// Computes the linearization from the residuals at the points of difference_points().
Linearization differences(const DesignSpace& space,
                          const std::vector<DesignPoint>& points,
                          const std::vector<Eigen::VectorXd>& residuals);

}  // namespace latsch
