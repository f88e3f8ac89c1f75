// SPDX-License-Identifier: Apache-2.0
// What the data determine at a fitted point, from the residuals and their derivatives alone.
//
// Residuals r(u) of m measured values, each divided by its noise or weighted alike, in n variables
// u of the unit cube; J = dr/du at, or near, the least sum of squares S = r' r. In linear
// approximation
//   s^2 = S / (m - n)                 variance of a residual, where it is not given
//   C   = s^2 (J' J)^-1               covariance of the variables
//   u_i +- (t sqrt(C_ii) + |d_i|)     confidence interval, t of Student's distribution
//   d = -(J' J)^-1 J' r               what the search left of the way to the least S
// [Bard, Nonlinear Parameter Estimation, 1974, ch. 7; Seber, Wild, Nonlinear Regression, 1989, ch.
// 5]
//
// Singular values of J tell how strongly the data hold the directions of the unit cube: along
// direction v_k the standard deviation is s / sigma_k; where that is more than the range itself the
// data say nothing. A variable at a bound towards which S falls is held there; its interval is
// one-sided, from  S(u_i) - S <= s^2 t^2  with the others refitted.
//
// Exact for linear models and Gaussian noise; elsewhere a profile (profile.h) tells more. The
// interval is that of the least-squares fit of these residuals.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "optimization/design_space.h"
#include "optimization/generating_set.h"

namespace latsch {

/// Residuals and their derivatives at a point of the unit cube.
struct Linearization {
  Eigen::VectorXd u;  // n
  Eigen::VectorXd r;  // m
  Eigen::MatrixXd J;  // m x n

  double sum_of_squares() const { return r.squaredNorm(); }
};

struct ConfidenceOptions {
  std::optional<double> sigma = std::nullopt;  // standard deviation of a residual, where known
  double level = 0.95;
  /// Where the spread is estimated: no residual is computed more exactly. Keeps the intervals of a
  /// perfect fit, a model fitted to itself, from having no width at all.
  double least_sigma = 1e-9;
};

/// Two ends in the unit cube, not cut off at its faces; infinite where nothing holds the variable.
struct Interval {
  double lower, upper;
};

struct Confidence {
  double sigma;             // of a residual; NaN where there are no more residuals than variables
  double t;                 // Student's quantile, two-sided
  std::vector<Bound> held;  // variables that their bound keeps from a better fit
  Eigen::VectorXd singular_values;  // descending, of all variables
  Eigen::MatrixXd directions;       // a column of the unit cube each
  Eigen::MatrixXd covariance;       // 0 in rows and columns of held variables
  Eigen::MatrixXd correlation;      // as well
  std::vector<Interval> intervals;

  /// s^2 t^2: the S above its least that still belongs to the interval.
  double threshold() const { return sigma * sigma * t * t; }
  /// Standard deviation along direction k, in ranges of the variables.
  double deviation(int k) const { return sigma / singular_values[k]; }
};

/// Needs a residual at least.
Confidence confidence(const Linearization& at, const ConfidenceOptions& options = {});

/// The points of which J is taken by differences: the center, then one step in each variable of the
/// unit cube, inward, and inside the linear constraints where one of both sides is.
std::vector<DesignPoint> difference_points(const DesignSpace& space,
                                           const DesignPoint& center,
                                           double step = 0.01);

/// Places of the residuals that are known, not NaN, at all points.
std::vector<Eigen::Index> known_residuals(const std::vector<Eigen::VectorXd>& residuals);

/// Linearization from the residuals at difference_points.
Linearization differences(const DesignSpace& space,
                          const std::vector<DesignPoint>& points,
                          const std::vector<Eigen::VectorXd>& residuals);

}  // namespace latsch
