// SPDX-License-Identifier: Apache-2.0
#include "optimization/identifiability/confidence.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>

#include "base/random.h"

namespace latsch {
namespace {

/// Returns the straight line y = a + b x at x = 0 .. m - 1, fitted to y by u = (a, b).
Linearization line(const Eigen::VectorXd& y) {
  Linearization at;
  at.J.resize(y.size(), 2);
  at.J.col(0).setConstant(-1.0);
  at.J.col(1) = -Eigen::VectorXd::LinSpaced(y.size(), 0.0, static_cast<double>(y.size() - 1));
  at.u = (-at.J).householderQr().solve(y);
  at.r = y + at.J * at.u;
  return at;
}

// The standard errors of a straight line are s^2 = S / (m - 2), var b = s^2 / Sxx, var a = s^2 (1/m
// + mean(x)^2 / Sxx), cov = -s^2 mean(x) / Sxx. Here m = 5, Sxx = 10, mean(x) = 2.
TEST(Confidence, AStraightLineHasItsTextbookIntervals) {
  const Linearization at = line(Eigen::VectorXd{{0.31, 0.39, 0.52, 0.58, 0.70}});
  const Confidence c = confidence(at);
  const double s2 = at.sum_of_squares() / 3;
  EXPECT_NEAR(c.sigma * c.sigma, s2, 1e-15);
  EXPECT_NEAR(c.t, 3.182446, 1e-6);
  EXPECT_NEAR(c.covariance(1, 1), s2 / 10, 1e-12);
  EXPECT_NEAR(c.covariance(0, 0), s2 * (1.0 / 5 + 4.0 / 10), 1e-12);
  EXPECT_NEAR(c.correlation(0, 1), -0.2 / std::sqrt(0.6 * 0.1), 1e-12);
  EXPECT_NEAR(c.intervals[1].upper - at.u[1], c.t * std::sqrt(s2 / 10), 1e-12);
  // The product of the squared singular values is det J'J = m Sxx.
  EXPECT_NEAR(std::pow(c.singular_values.prod(), 2), 50.0, 1e-10);
}

// With a + b = c the line y = a + b x is y - c x = a (1 - x), so that var a = s^2 / sum (1 - x)^2
// with s^2 = S / (m - 1), and b has the same variance.
TEST(Confidence, AnEquationBetweenTwoVariablesLeavesOneUnknown) {
  const Eigen::VectorXd y{{0.31, 0.39, 0.52, 0.58, 0.70}};
  const double sum = 0.45;
  Linearization at = line(y);
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(5, 0.0, 4.0);
  const Eigen::VectorXd X = Eigen::VectorXd::Ones(5) - x;
  const double a = X.dot(y - sum * x) / X.squaredNorm();
  at.u = Eigen::Vector2d(a, sum - a);
  at.r = y + at.J * at.u;
  const Confidence c =
      confidence(at, {.plane = EqualPlane(Eigen::RowVector2d(1.0, 1.0) / std::sqrt(2.0))});
  const double s2 = at.sum_of_squares() / 4, variance = s2 / X.squaredNorm();
  EXPECT_NEAR(c.sigma * c.sigma, s2, 1e-15);
  EXPECT_NEAR(c.t, 2.776445, 1e-6);
  EXPECT_NEAR(c.correlation(0, 1), -1.0, 1e-12);
  EXPECT_EQ(c.directions.cols(), 1);
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(c.covariance(i, i), variance, 1e-14);
    EXPECT_NEAR(c.intervals[i].upper - at.u[i], c.t * std::sqrt(variance), 1e-12);
  }
  EXPECT_NEAR(c.left_to_gain, 0.0, 1e-12);
}

// A variable that an equation determines can be replaced in the residuals. The intervals of the
// others are those of this smaller problem, also if a bound holds one of them, if neighbors share
// noise, or if a loss limits residuals.
TEST(Confidence, AnEquationGivesTheIntervalsOfTheProblemWithoutOneOfItsVariables) {
  constexpr int kValues = 40;
  for (std::uint64_t seed = 1; seed < 9; ++seed) {
    RandomStream random(seed, 3);
    Linearization at{Eigen::Vector3d(0.5, 0.3, seed % 2 == 0 ? 0.0 : 0.2),
                     Eigen::VectorXd(kValues),
                     Eigen::MatrixXd(kValues, 3)};
    const Eigen::RowVector3d normal(2.0, 1.0, -0.5);
    for (int k = 0; k < kValues; ++k) {
      for (int j = 0; j < 3; ++j) at.J(k, j) = random.normal();
      at.r[k] = 0.05 * random.normal() + (k > 0 ? 0.6 * at.r[k - 1] : 0.0);
    }
    // The residuals grow if the third variable does, so that its bound may hold it.
    at.r += 0.1 * at.J.col(2);
    ConfidenceOptions options;
    if (seed > 4) options.traits.curves.assign(kValues, 0);
    if (seed == 3 || seed == 4) options.traits.losses.assign(kValues, {Loss::huber, 0.05});
    if (seed == 4) options.sigma = 0.05;
    Linearization smaller{at.u({0, 2}), at.r, Eigen::MatrixXd(kValues, 2)};
    smaller.J.col(0) = at.J.col(0) - normal[0] / normal[1] * at.J.col(1);
    smaller.J.col(1) = at.J.col(2) - normal[2] / normal[1] * at.J.col(1);
    // The point is the least sum of squares beside the bound; J is known within the plane alone.
    const Eigen::VectorXd own = smaller.J.col(0);
    if (seed % 2 == 0) at.r -= own * own.dot(at.r) / own.squaredNorm();
    smaller.r = at.r;
    at.J = EqualPlane(normal / normal.norm()).projected(at.J);
    const Confidence expected = confidence(smaller, options);
    options.plane = EqualPlane(normal / normal.norm());
    const Confidence found = confidence(at, options);
    EXPECT_EQ(found.held[2], expected.held[1]);
    EXPECT_EQ(found.is_colored, expected.is_colored);
    for (const auto& [i, j] : {std::pair(0, 0), std::pair(2, 1)}) {
      const double width = std::isfinite(expected.intervals[j].lower)
                               ? expected.intervals[j].upper - expected.intervals[j].lower
                               : expected.intervals[j].upper;
      EXPECT_NEAR(found.intervals[i].upper, expected.intervals[j].upper, 1e-6 * width) << seed;
      if (std::isfinite(expected.intervals[j].lower))
        EXPECT_NEAR(found.intervals[i].lower, expected.intervals[j].lower, 1e-6 * width) << seed;
      EXPECT_NEAR(found.thresholds[i], expected.thresholds[j], 1e-6 * expected.thresholds[j]);
    }
    // The third follows the equation.
    const Eigen::Vector3d variance = normal * found.covariance;
    EXPECT_LT(variance.norm(), 1e-9 * found.covariance.norm());
  }
}

// In a linear model, u + d is the least-squares solution, wherever the search stopped. The interval
// about the stopped point u therefore extends farther to each side, by |d|, than that of the
// solution.
TEST(Confidence, WhatTheSearchLeftOfTheWayWidensTheInterval) {
  const Linearization least = line(Eigen::VectorXd{{0.31, 0.39, 0.52, 0.58, 0.70}});
  const Eigen::Vector2d left(0.3, -0.2);
  Linearization stopped = least;
  stopped.u -= left;
  stopped.r -= least.J * left;
  const Confidence c = confidence(stopped, {.sigma = 0.01});
  const Confidence at_least = confidence(least, {.sigma = 0.01});
  for (int i = 0; i < 2; ++i) {
    const double half = at_least.intervals[i].upper - least.u[i];
    EXPECT_NEAR(c.intervals[i].upper - stopped.u[i], half + std::abs(left[i]), 1e-12);
    EXPECT_LT(c.intervals[i].lower, least.u[i]);
    EXPECT_GT(c.intervals[i].upper, least.u[i]);
  }
}

TEST(Confidence, ADirectionThatNoResidualFeelsIsInfinitelyWideAndTheOthersAreNot) {
  Linearization at;
  at.u = Eigen::Vector3d(0.5, 0.5, 0.5);
  at.J = Eigen::MatrixXd{{1, 1, 0}, {2, 2, 0}, {0, 0, 1}, {0, 0, 2}};
  at.r = Eigen::Vector4d(0.02, -0.01, 0.02, -0.01);
  const Confidence c = confidence(at, {.sigma = 0.01});
  EXPECT_GT(c.intervals[0].upper, 1e6);
  EXPECT_LT(c.intervals[1].lower, -1e6);
  EXPECT_NEAR(c.intervals[2].upper, 0.5 + 1.959964 * 0.01 / std::sqrt(5.0), 1e-6);
  EXPECT_NEAR(c.correlation(0, 1), -1.0, 1e-9);
  EXPECT_GT(c.deviation(2), 1e6);
}

// S = (u1 + 0.3)^2 + (u2 - 0.4)^2 inside u >= 0 has its minimum at (0, 0.4), S = 0.09, and grows
// from there as  2 0.3 d + d^2.
TEST(Confidence, AVariableAtItsBoundHasAOneSidedInterval) {
  Linearization at{Eigen::Vector2d(0, 0.4), Eigen::Vector2d(0.3, 0), Eigen::Matrix2d::Identity()};
  const Confidence c = confidence(at, {.sigma = 0.1});
  EXPECT_EQ(c.held[0], Bound::lower);
  EXPECT_EQ(c.held[1], Bound::none);
  const double d = c.intervals[0].upper;
  EXPECT_NEAR(0.6 * d + d * d, c.threshold(), 1e-12);
  EXPECT_EQ(c.covariance(0, 0), 0.0);
  EXPECT_NEAR(c.intervals[1].upper, 0.4 + 0.1959964, 1e-6);
}

// The data suggest u1 = -0.3 with a noise of 0.01, thirty deviations beyond the bound. If u1 were
// released, these residuals would vanish, so they are not noise, and u2 is as certain as without
// them.
TEST(Confidence, WhatABoundKeepsFromBeingReachedIsNoNoise) {
  Linearization at{Eigen::Vector2d(0, 0.4), Eigen::VectorXd::Zero(40), Eigen::MatrixXd(40, 2)};
  for (int j = 0; j < 40; ++j) {
    at.J.row(j) << (j < 20 ? 1.0 : 0.0), (j < 20 ? 0.0 : 1.0);
    at.r[j] = 0.01 * (j % 2 == 0 ? 1.0 : -1.0) + (j < 20 ? 0.3 : 0.0);
  }
  EXPECT_EQ(confidence(at, {.sigma = 0.01}).excess, 1.0);
  EXPECT_NEAR(confidence(at).sigma, 0.01 * std::sqrt(40.0 / 38.0), 1e-12);
}

// Two variables whose effects are the same, such as two bushings in a row, are at their bounds.
// Both together explain what one does, so the share is that of one of them.
TEST(Confidence, TheShareBeyondBoundsCountsEqualEffectsOnce) {
  Linearization at{Eigen::Vector3d(0, 0, 0.4), Eigen::VectorXd::Zero(40), Eigen::MatrixXd(40, 3)};
  for (int j = 0; j < 40; ++j) {
    at.J.row(j) << (j < 20 ? 1.0 : 0.0), (j < 20 ? 2.0 : 0.0), (j < 20 ? 0.0 : 1.0);
    at.r[j] = 0.01 * (j % 2 == 0 ? 1.0 : -1.0) + (j < 20 ? 0.3 : 0.0);
  }
  const Confidence c = confidence(at, {.sigma = 0.01});
  EXPECT_EQ(c.held, (std::vector<Bound>{Bound::lower, Bound::lower, Bound::none}));
  EXPECT_NEAR(c.share_beyond_bounds, 1.0 - 40 * 1e-4 / (40 * 1e-4 + 20 * 0.09), 1e-9);
}

TEST(Confidence, AsManyResidualsAsVariablesLeaveNothingToEstimateTheirSpreadFrom) {
  Linearization at{Eigen::Vector2d(0.5, 0.4), Eigen::Vector2d::Zero(), Eigen::Matrix2d::Identity()};
  EXPECT_TRUE(std::isnan(confidence(at).sigma));
  EXPECT_TRUE(std::isinf(confidence(at).intervals[0].upper));
}

/// Returns noise of variance 1 that neighbors share: an autoregression of order 1.
Eigen::VectorXd colored_noise(int count, double kappa, RandomStream random) {
  Eigen::VectorXd e(count);
  e[0] = random.normal();
  for (int j = 1; j < count; ++j) {
    e[j] = kappa * e[j - 1] + std::sqrt(1.0 - kappa * kappa) * random.normal();
  }
  return e;
}

// The level and the slope of a line are estimated from 300 data sets whose noise is shared by
// neighbors. The observed share of intervals that contain the true value, 0.95, has a standard
// error of 0.0126.
TEST(Confidence, NeighborsThatShareNoiseAreNotIndependent) {
  constexpr int kSets = 300, kSamples = 200;
  int held[2] = {};
  const Eigen::VectorXd truth =
      Eigen::VectorXd::LinSpaced(kSamples, 0.5, 0.5 + 0.5 * (kSamples - 1));
  for (int set = 0; set < kSets; ++set) {
    const Linearization at =
        line(truth + 0.05 * colored_noise(kSamples, 0.8, RandomStream(7, set)));
    const Confidence c = confidence(at, {.traits = {.curves = std::vector<int>(kSamples, 0)}});
    EXPECT_TRUE(c.is_colored);
    for (int i = 0; i < 2; ++i) {
      held[i] += c.intervals[i].lower <= 0.5 && 0.5 <= c.intervals[i].upper;
    }
  }
  for (const int count : held) EXPECT_NEAR(static_cast<double>(count) / kSets, 0.95, 0.025);
}

// A few values are wrong, and all others are exact. A robust loss makes the derivatives of the
// wrong values zero, so the values share no noise, and the intervals are those of independent
// residuals of spread s, where s^2 = sum r^2 / (m - n). The rows of J are those of a straight line,
// and 0 at the wrong values.
TEST(Confidence, ExactValuesBesideAFewFarOffShareNoNoise) {
  constexpr int m = 21;
  for (const std::vector<int>& wrong : {std::vector{10}, std::vector{3}, std::vector{4, 15}}) {
    Linearization at = line(Eigen::VectorXd::LinSpaced(m, 0.2, 0.8));
    for (const double rounding : {0.0, 1e-12}) {
      for (int k = 0; k < m; ++k) at.r[k] = rounding * std::cos(7.0 * k * k);
      for (const int k : wrong) {
        at.r[k] = 0.03;
        at.J.row(k).setZero();
      }
      const Confidence c = confidence(
          at, {.least_noise = 1e-5, .traits = {.deviations = {}, .curves = std::vector(m, 0)}});
      EXPECT_FALSE(c.is_colored);
      const double s2 = 9e-4 * static_cast<double>(wrong.size()) / (m - 2);
      const Eigen::Matrix2d C = s2 * Eigen::Matrix2d(at.J.transpose() * at.J).inverse();
      for (int i = 0; i < 2; ++i)
        EXPECT_NEAR(0.5 * (c.intervals[i].upper - c.intervals[i].lower) / c.t,
                    std::sqrt(C(i, i)),
                    1e-6 * std::sqrt(C(i, i)));
    }
  }
}

// If neighbors share noise, a few wrong values must not make the others count as exact.
TEST(Confidence, NoiseBesideAValueFarOffIsStillShared) {
  constexpr int m = 200;
  const Eigen::VectorXd y =
      Eigen::VectorXd::LinSpaced(m, 0.2, 0.8) + 0.05 * colored_noise(m, 0.8, RandomStream(7, 0));
  Linearization at = line(y);
  at.r[100] = 0.2;
  const Confidence c = confidence(
      at, {.least_noise = 1e-5, .traits = {.deviations = {}, .curves = std::vector(m, 0)}});
  EXPECT_TRUE(c.is_colored);
}

// Residuals that are twice as large as the stated noise in 100 values are not due to chance, so the
// interval follows from the observed spread.
TEST(Confidence, ResidualsLargerThanTheirStatedNoiseWidenTheIntervals) {
  Linearization at = line(2.0 * colored_noise(100, 0.0, RandomStream(3, 1)));
  at.u.setConstant(0.5);  // a point that is not on a bound
  const Confidence stated = confidence(at, {.sigma = 1.0}), seen = confidence(at);
  EXPECT_NEAR(stated.excess, 2.0, 0.3);
  EXPECT_NEAR(stated.intervals[1].upper, seen.intervals[1].upper, 1e-12);
  EXPECT_EQ(confidence(at, {.sigma = 2.0}).excess, 1.0);
}

// A weight of 4 doubles a residual relative to its noise. The fit then agrees with this value more
// than its noise justifies, and the interval accounts for the noise. The mean of two values with
// weights 4 and 1 has the variance (16 + 1) / 25.
TEST(Confidence, AWeightIsNotTakenForExactness) {
  Linearization at{Eigen::VectorXd::Constant(1, 0.5), Eigen::Vector2d::Zero(), {}};
  at.J = Eigen::Vector2d(2, 1);
  const Confidence c = confidence(at, {.sigma = 1.0, .traits = {.deviations = {2.0, 1.0}}});
  EXPECT_NEAR(c.covariance(0, 0), 17.0 / 25.0, 1e-12);
}

// If the model's values are too large by 0.3 - 0.02 x, the fitted line is lower by 0.3 - 0.02 x. If
// the slope is held, the level is lower by the mean of this error, 0.3 - 0.02 * 2.
TEST(Confidence, ALinearModelsBiasShiftsTheLeastSquaresByIt) {
  const Linearization at = line(Eigen::VectorXd{{0.31, 0.39, 0.52, 0.58, 0.70}});
  const Eigen::VectorXd change = at.J * Eigen::Vector2d(-0.3, 0.02) * -1.0;
  const Eigen::VectorXd free = shift_of(at, {Bound::none, Bound::none}, change);
  EXPECT_NEAR(free[0], -0.3, 1e-12);
  EXPECT_NEAR(free[1], 0.02, 1e-12);
  const Eigen::VectorXd held = shift_of(at, {Bound::none, Bound::upper}, change);
  EXPECT_NEAR(held[0], -0.26, 1e-12);
  EXPECT_EQ(held[1], 0.0);
}

// The result is not shifted along a direction on which no residual depends.
TEST(Confidence, NothingIsShiftedAlongAFlatDirection) {
  Linearization at{Eigen::VectorXd::Constant(2, 0.5), Eigen::Vector3d::Zero(), {}};
  at.J = Eigen::MatrixXd{{1, 1}, {2, 2}, {3, 3}};
  const Eigen::VectorXd shift =
      shift_of(at, {Bound::none, Bound::none}, Eigen::Vector3d(0.1, 0.2, 0.3));
  EXPECT_NEAR(shift[0], -0.05, 1e-12);
  EXPECT_NEAR(shift[1], -0.05, 1e-12);
}

// Differences of a linear function are exact; at the upper bound the points lie inward.
TEST(Confidence, DifferencesGiveTheDerivativesOfALinearFunction) {
  const DesignSpace space({{.name = "a", .lower = 1, .upper = 3, .initial = 3}, {.name = "b"}});
  const auto points = difference_points(space, space.initial());
  std::vector<Eigen::VectorXd> r;
  for (const DesignPoint& p : points) {
    EXPECT_TRUE(space.contains(p));
    r.push_back(Eigen::Vector3d(2 * p.values[0] - p.values[1], p.values[1], NAN));
  }
  const auto known = known_residuals(r);
  ASSERT_EQ(known.size(), 2u);
  for (auto& v : r) v = Eigen::VectorXd(v(known));
  const Linearization at = differences(space, points, r);
  EXPECT_TRUE(at.J.isApprox(Eigen::Matrix2d{{4, -1}, {0, 1}}, 1e-12));
}

}  // namespace
}  // namespace latsch
