// SPDX-License-Identifier: Apache-2.0
// What the data determine at a fitted point, from the residuals and their derivatives alone.
//
// Residuals r(u) of m measured values, each divided by its noise or weighted alike, in n variables
// u of the unit cube; J = dr/du at, or near, the least sum of squares S = r' r. In linear
// approximation
//   s^2 V                               covariance of the residuals (residual_noise.h), V = 1 where
//                                       they are alike and independent, s^2 = S / (m - n) then
//   C = s^2 (J' J)^-1 J' V J (J' J)^-1  covariance of the variables
//   u_i +- (t sqrt(C_ii) + |d_i|)       confidence interval, t of Student's distribution
//   d = -(J' J)^-1 J' r                 what the search left of the way to the least S
// [Bard, Nonlinear Parameter Estimation, 1974, ch. 7; Seber, Wild, Nonlinear Regression, 1989,
// ch. 5]
//
// Singular values of J tell how strongly the data hold the directions of the unit cube: along
// direction v_k the standard deviation is s / sigma_k; where that is more than the range itself the
// data say nothing. A variable at a bound towards which S falls is held there; its interval is
// one-sided, from  S(u_i) - S <= threshold  with the others refitted, the threshold being that S at
// the ends of a two-sided interval: s^2 t^2 where residuals are alike and independent. What such a
// variable would explain if it were let go is no noise: s is estimated from what no variable can.
//
// A fit without noise, of a model to itself, leaves rounding of the simulations: less than
// `least_noise`, or than a thousandth of the stated noise. In it V = 1, and a variable counts as
// held by its bound only where it would leave it by more than that makes of it. So its intervals
// follow from J alone, wherever the search began.
//
// Where s is stated and the residuals are larger than that explains, once in a thousand, either the
// model cannot follow the measurement or the search has ended early: intervals then take the
// spread that is seen, and `excess` says by how much it is larger.
//
// Exact for linear models and Gaussian noise; elsewhere a profile (profile.h) tells more. The
// interval is that of the least-squares fit of these residuals.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "optimization/identifiability/residual_noise.h"
#include "optimization/problem/design_space.h"
#include "optimization/region/generating_set.h"

namespace latsch {

/// What an evaluation tells: residuals, and dr/du where the model knows its slopes.
struct Evaluated {
  Evaluated(Eigen::VectorXd residuals, Eigen::MatrixXd slopes = {})
      : r(std::move(residuals)), J(std::move(slopes)) {}

  bool has_slopes() const { return J.size() > 0; }
  Evaluated of(const std::vector<Eigen::Index>& rows) const {
    return {r(rows), has_slopes() ? Eigen::MatrixXd(J(rows, Eigen::all)) : Eigen::MatrixXd()};
  }

  Eigen::VectorXd r;
  Eigen::MatrixXd J;        // empty: not known
  bool is_reduced = false;  // the rows are those of reduced_rows.h
};

/// Residuals and their derivatives at a point of the unit cube.
struct Linearization {
  Eigen::VectorXd u;      // n
  Eigen::VectorXd r;      // m
  Eigen::MatrixXd J;      // m x n
  bool is_exact = false;  // J is the model's own, not made of differences

  double sum_of_squares() const { return r.squaredNorm(); }
};

struct ConfidenceOptions {
  std::optional<double> sigma = std::nullopt;  // standard deviation of a residual, where known
  double level = 0.95;
  /// Where the spread is estimated: no residual is computed more exactly. Keeps the intervals of a
  /// perfect fit, a model fitted to itself, from having no width at all.
  double least_sigma = 1e-9;
  /// Where the spread is estimated: less of it is rounding of the simulations and no noise, so no
  /// correlation of neighbors is looked for in it. In the unit of the residuals: of relative
  /// differences 1e-5 is less than any laboratory leaves.
  double least_noise = 1e-9;
  ResidualTraits traits = {};
};

/// Two ends in the unit cube, not cut off at its faces; infinite where nothing holds the variable.
struct Interval {
  double lower, upper;
};

/// What the data say of the variables that no bound holds, direction by direction: what values that
/// follow from the variables are as uncertain as (prediction_band.h).
struct FreeDirections {
  Eigen::MatrixXd axes;        // n x f: a direction of the unit cube each, 0 in held variables
  Eigen::MatrixXd covariance;  // f x f: of the place along each
  Eigen::VectorXd left;        // f: what the search left of the way along each; 0 where flat
  Eigen::MatrixXd following;   // f x n: how far each moves with a held variable, by the refit
  double t = 0.0;              // the largest quantile of an interval
};

struct Confidence {
  double sigma;             // of a residual; NaN where there are no more residuals than variables
  double t;                 // Student's quantile, two-sided, of independent residuals
  std::vector<Bound> held;  // variables that their bound keeps from a better fit
  Eigen::VectorXd singular_values;  // descending, of all variables
  Eigen::MatrixXd directions;       // a column of the unit cube each
  Eigen::MatrixXd covariance;       // 0 in rows and columns of held variables
  Eigen::MatrixXd correlation;      // as well
  std::vector<Interval> intervals;
  /// Of every variable: the S above its least that still belongs to its interval.
  std::vector<double> thresholds;
  Eigen::VectorXd direction_deviations;
  /// Standard deviation of every residual as the variables feel it: a share in what its neighbors
  /// have in common included.
  Eigen::VectorXd noise;
  /// The residuals' spread over the one stated, where that cannot be chance; 1 otherwise.
  double excess = 1.0;
  bool is_colored = false;    // neighbors share noise
  double left_to_gain = 0.0;  // S - least S, as J promises inside the bounds of held variables
  FreeDirections free;

  /// s^2 t^2: of independent residuals.
  double threshold() const { return sigma * sigma * t * t; }
  /// Standard deviation along direction k, in ranges of the variables; infinite where flat.
  double deviation(int k) const { return direction_deviations[k]; }
};

/// What a sum of squares of nu squared standard normal numbers exceeds once in a thousand, over nu
/// [Wilson, Hilferty, Proc. Nat. Acad. Sci. 17 (1931) 684].
double rare_ratio(double nu);

/// Needs a residual at least.
Confidence confidence(const Linearization& at, const ConfidenceOptions& options = {});

/// The confidence of some of the variables as one of all: the others stand at `u`, have an interval
/// of no width, no covariance and no part in any direction. There is a direction a free variable.
Confidence of_all_variables(Confidence part,
                            const std::vector<int>& free,
                            const Eigen::VectorXd& u);

/// How far from here the least sum of squares lies when all residuals change by `change`,
/// -(J'J)^-1 J' change in the variables that are not held: what a model that computes otherwise
/// does to its numbers. 0 in held ones and along directions that no residual feels.
Eigen::VectorXd shift_of(const Linearization& at,
                         const std::vector<Bound>& held,
                         const Eigen::VectorXd& change);

/// The points of which J is taken by differences: the center, then one step in each variable of the
/// unit cube, inward, and inside the linear constraints where one of both sides is. `steps`: one a
/// variable; 0, or none at all: 0.01.
std::vector<DesignPoint> difference_points(const DesignSpace& space,
                                           const DesignPoint& center,
                                           const Eigen::VectorXd& steps = {});

/// Places of the residuals that are known, not NaN, at all points.
std::vector<Eigen::Index> known_residuals(const std::vector<Eigen::VectorXd>& residuals);

/// Linearization from the residuals at difference_points.
Linearization differences(const DesignSpace& space,
                          const std::vector<DesignPoint>& points,
                          const std::vector<Eigen::VectorXd>& residuals);

}  // namespace latsch
