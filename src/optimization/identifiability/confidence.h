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
// [Bard, Nonlinear Parameter Estimation, 1974, ch. 7; Seber, Wild, Nonlinear Regression, 1989,
// ch. 5]
//
// The singular values of J show how strongly the data determine the directions of the unit cube:
// along direction v_k the standard deviation is s / sigma_k. If s / sigma_k exceeds the range
// itself, the data determine nothing along v_k. A variable at a bound is held there if S falls
// toward the bound. Its interval is one-sided, from  S(u_i) - S <= threshold  with the other
// variables refitted. The threshold is this difference at the ends of a two-sided interval: s^2 t^2
// if the residuals are alike and independent. The part of the residuals that a held variable would
// explain if released is not noise, so s is estimated from the part that no variable can explain.
//
// A fit without noise, of a model to itself, leaves only rounding errors of the simulations: less
// than `least_noise`, or less than a thousandth of the stated noise. For such residuals V = 1, and
// a variable counts as held by its bound only if it would leave the bound by more than the rounding
// errors explain. The intervals then follow from J alone, wherever the search began.
//
// If s is stated and the residuals are larger than it explains (chance of one in a thousand),
// either the model cannot reproduce the measurement or the search has ended early. The intervals
// then use the observed spread, and `excess` is its ratio to the stated one.
//
// Residuals with a robust loss (robust_loss.h) have the covariance of M-estimation in the place of
// C (robust_rows.h), with A in the place of J'J: the curvature of S is lower beyond the corner of a
// loss, and a value there moves the fit no more than one at the corner. Thresholds are the rise of
// S at the ends of these intervals, t^2 C_ii / (A^-1)_ii, so that profiles agree. The degrees of
// freedom are m - n as without a loss. If the noise is stated, no `excess` is looked for: values
// beyond the corner are counted and widen the intervals. If psi' is 1 for all values, everything is
// as without a loss.
//
// The result is exact for linear models and Gaussian noise without a loss; otherwise a profile
// (profile.h) is more reliable. The interval is that of the fit that minimizes S.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "optimization/identifiability/residual_noise.h"
#include "optimization/problem/design_space.h"
#include "optimization/region/generating_set.h"

namespace latsch {

/// Result of an evaluation: residuals, and dr/du if the model computes its slopes.
struct Evaluated {
  /// Takes residuals, and their slopes if the model computes them.
  Evaluated(Eigen::VectorXd residuals, Eigen::MatrixXd slopes = {})
      : r(std::move(residuals)), J(std::move(slopes)) {}

  /// True if the model computed dr/du.
  bool has_slopes() const { return J.size() > 0; }
  /// Returns only these rows.
  Evaluated of(const std::vector<Eigen::Index>& rows) const {
    return {r(rows), has_slopes() ? Eigen::MatrixXd(J(rows, Eigen::all)) : Eigen::MatrixXd()};
  }

  Eigen::VectorXd r;        // m residuals
  Eigen::MatrixXd J;        // empty: not known
  bool is_reduced = false;  // the rows are those of reduced_rows.h
};

/// Residuals and their derivatives at a point of the unit cube.
struct Linearization {
  Eigen::VectorXd u;      // n
  Eigen::VectorXd r;      // m
  Eigen::MatrixXd J;      // m x n
  bool is_exact = false;  // J is the model's own, not computed by differences

  /// Returns S = r'r.
  double sum_of_squares() const { return r.squaredNorm(); }
};

/// Noise of the residuals and level of the intervals.
struct ConfidenceOptions {
  std::optional<double> sigma = std::nullopt;  // standard deviation of a residual, if known
  double level = 0.95;  // probability that an interval contains the true value
  /// Least standard deviation used if the spread is estimated, because no residual is computed more
  /// exactly. It keeps the intervals of a perfect fit, a model fitted to itself, from having no
  /// width.
  double least_sigma = 1e-9;
  /// If the spread is estimated, a smaller spread counts as rounding of the simulations and not as
  /// noise, so no correlation of neighbors is looked for in it. In the unit of the residuals: for
  /// relative differences 1e-5 is less than the noise of any laboratory.
  double least_noise = 1e-9;
  ResidualTraits traits = {};  // groups and order of the residuals, for noise that neighbors share
};

/// Two ends in the unit cube, not cut off at its faces; infinite if nothing determines the
/// variable.
struct Interval {
  double lower, upper;  // coordinates of the unit cube
};

/// Uncertainty of the variables that no bound holds, direction by direction. The uncertainty of
/// values computed from the variables follows from it (prediction_band.h).
struct FreeDirections {
  Eigen::MatrixXd axes;        // n x f: columns are directions; 0 in held variables
  Eigen::MatrixXd covariance;  // f x f: of the coordinates along the directions
  Eigen::VectorXd left;        // f: remaining distance to the least S along each; 0 if flat
  Eigen::MatrixXd following;   // f x n: motion along each per held variable, by the refit
  double t = 0.0;              // the largest quantile of an interval
};

struct Confidence {
  /// Deviation of a residual, of its psi if losses limit residuals and no noise is stated; NaN
  /// unless residuals outnumber variables.
  double sigma;
  double t;                         // Student's quantile, two-sided, of independent residuals
  std::vector<Bound> held;          // variables whose bound prevents a better fit
  Eigen::VectorXd singular_values;  // descending, of all variables: of J, or of the root of A
  Eigen::MatrixXd directions;       // each column a direction of the unit cube
  Eigen::MatrixXd covariance;       // 0 in rows and columns of held variables
  Eigen::MatrixXd correlation;      // 0 in rows and columns of held variables, too
  std::vector<Interval> intervals;  // one for each variable
  /// One threshold for each variable: the difference S - least S up to which values belong to its
  /// interval.
  std::vector<double> thresholds;
  /// Standard deviation along each direction, in ranges of the variables; infinite if flat.
  Eigen::VectorXd direction_deviations;
  /// Standard deviation of every residual as it acts on the variables, including the part it shares
  /// with its neighbors.
  Eigen::VectorXd noise;
  /// Ratio of the residuals' spread to the stated one if chance cannot explain it; 1 otherwise.
  double excess = 1.0;
  bool is_colored = false;       // neighbors share noise
  double left_to_gain = 0.0;     // S - least S, as J predicts inside the bounds of held variables
  int with_loss = 0;             // number of residuals with a robust loss
  int beyond = 0;                // number of these beyond the corner of their loss
  double expected_beyond = 0.0;  // share of these that stated Gaussian noise leaves there
  /// Share of a change of each residual that moves the least S; empty if all of it does.
  Eigen::VectorXd felt_changes;
  FreeDirections free;  // directions of the variables that no bound holds

  /// Returns s^2 t^2, the threshold for independent residuals.
  double threshold() const { return sigma * sigma * t * t; }
  /// Standard deviation along direction k, in ranges of the variables; infinite if flat.
  double deviation(int k) const { return direction_deviations[k]; }
};

/// Returns the ratio to nu that a sum of squares of nu standard normal numbers exceeds with a
/// chance of one in a thousand [Wilson, Hilferty, Proc. Nat. Acad. Sci. 17 (1931) 684].
double rare_ratio(double nu);

/// Needs at least one residual.
Confidence confidence(const Linearization& at, const ConfidenceOptions& options = {});

/// Extends the confidence of some of the variables to all of them. The other variables stay at `u`
/// and have an interval of no width, no covariance and no part in any direction. The number of
/// directions is that of the free variables.
Confidence of_all_variables(Confidence part,
                            const std::vector<int>& free,
                            const Eigen::VectorXd& u);

/// Returns the shift of the least sum of squares if all residuals change by `change`, -(J'J)^-1 J'
/// change in the variables that are not held. A model that computes differently changes its values
/// by this shift. It is 0 in held variables and along directions that no residual depends on.
/// `felt_changes` are those of the confidence; with them J'J and J' contain them as weights.
Eigen::VectorXd shift_of(const Linearization& at,
                         const std::vector<Bound>& held,
                         const Eigen::VectorXd& change,
                         const Eigen::VectorXd& felt_changes = {});

/// Returns the points from which J is computed by differences: the center, then one step in each
/// variable of the unit cube, inward, and inside the linear constraints if one of the two sides is.
/// `steps` has one entry for each variable; 0 or an empty vector means 0.01.
std::vector<DesignPoint> difference_points(const DesignSpace& space,
                                           const DesignPoint& center,
                                           const Eigen::VectorXd& steps = {});

/// Returns the indices of the residuals that are known, not NaN, at all points.
std::vector<Eigen::Index> known_residuals(const std::vector<Eigen::VectorXd>& residuals);

/// Computes the linearization from the residuals at difference_points.
Linearization differences(const DesignSpace& space,
                          const std::vector<DesignPoint>& points,
                          const std::vector<Eigen::VectorXd>& residuals);

}  // namespace latsch
