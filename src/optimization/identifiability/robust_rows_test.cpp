// SPDX-License-Identifier: Apache-2.0
// Tests the formulas of M-estimation on small data sets. The coverage of the intervals is tested
// with NumPy in apps/python/tests/robust_intervals_test.py.
#include "optimization/identifiability/robust_rows.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "optimization/identifiability/identification.h"

namespace latsch {
namespace {

constexpr double kHuberCorner = 1.345;  // corner with 95 % of the efficiency of least squares

TEST(RobustLoss, TheErrorFollowsFromItsResidual) {
  for (const Loss loss : {Loss::huber, Loss::cauchy}) {
    const RobustLoss robust{loss, 0.5};
    for (const double x : {0.0, 1e-9, 0.3, -0.49, 0.51, -2.0, 40.0, 1e5}) {
      const LimitedResidual one = robust.at(robust(x));
      const double h = 1e-6 * std::max(1e-3, std::abs(x));
      EXPECT_NEAR(one.slope, robust.slope(x), 1e-9 * std::abs(one.slope)) << x;
      EXPECT_NEAR(one.psi, robust(x) * robust.slope(x), 1e-9 * std::abs(one.psi)) << x;
      const auto psi = [&](double at) { return robust.at(robust(at)).psi; };
      EXPECT_NEAR(one.psi_slope, (psi(x + h) - psi(x - h)) / (2.0 * h), 1e-4) << x;
      EXPECT_EQ(one.is_beyond, std::abs(x) > 0.5) << x;
    }
  }
  // The corresponding error exceeds the largest double.
  EXPECT_EQ(RobustLoss(Loss::cauchy, 1.0).at(40.0).psi, 0.0);
}

// The efficiency with Gaussian noise, (E psi')^2 / E psi^2, is 0.95 for the default corners of both
// losses. For Huber's loss, psi^2 beyond the corner equals that at the corner.
TEST(RobustLoss, ExpectationsAreThoseOfGaussianNoise) {
  const GaussianLoss huber = RobustLoss{Loss::huber, kHuberCorner}.expected(1.0);
  const double square =
      huber.inside * (1.0 - huber.beyond) + kHuberCorner * kHuberCorner * huber.beyond;
  EXPECT_NEAR(huber.psi_slope * huber.psi_slope / square, 0.95, 1e-4);
  EXPECT_NEAR(huber.beyond, 0.17863, 1e-5);
  const RobustLoss cauchy{Loss::cauchy, 2.385};
  RandomStream random(1, 0);
  double slopes = 0.0, squares = 0.0, inside = 0.0;
  constexpr int kDraws = 200'000;
  for (int k = 0; k < kDraws; ++k) {
    const LimitedResidual one = cauchy.at(cauchy(random.normal()));
    slopes += one.psi_slope;
    if (one.is_beyond) continue;
    squares += one.psi * one.psi;
    inside += 1.0;
  }
  EXPECT_NEAR(cauchy.expected(1.0).psi_slope, slopes / kDraws, 0.003);
  EXPECT_NEAR(cauchy.expected(1.0).inside, squares / inside, 0.005);
  // Expectations depend only on the ratio of the corner to the standard deviation of the noise.
  const RobustLoss small{Loss::cauchy, 2.385e-3};
  EXPECT_NEAR(small.expected(1e-3).psi_slope, cauchy.expected(1.0).psi_slope, 1e-12);
}

TEST(RobustRows, NegativeWeightsAreTakenFromTheSum) {
  const Eigen::MatrixXd J{{1, 0.2}, {1, 0.5}, {1, 0.9}, {1, 2.0}};
  const Eigen::VectorXd w{{1.0, 0.8, 0.9, -0.05}};
  const Eigen::MatrixXd H = weighted_rows(J, w);
  EXPECT_TRUE((H.transpose() * H).isApprox(J.transpose() * w.asDiagonal() * J, 1e-12));
  const Eigen::VectorXd positive{{1.0, 0.8, 0.9, 0.05}};
  const Eigen::MatrixXd G = weighted_rows(J, positive);
  EXPECT_TRUE((G.transpose() * G).isApprox(J.transpose() * positive.asDiagonal() * J, 1e-12));
}

TEST(RobustRows, TheLargerOfTwoIsNoSmallerAlongAnyDirection) {
  const Eigen::MatrixXd a{{2.0, 0.3}, {0.3, 1.0}}, b{{0.5, 0.4}, {0.4, 3.0}};
  const Eigen::MatrixXd both = larger(a, b);
  for (int k = 0; k < 12; ++k) {
    const Eigen::Vector2d v(std::cos(0.3 * k), std::sin(0.3 * k));
    EXPECT_GE(v.dot(both * v), std::max(v.dot(a * v), v.dot(b * v)) - 1e-12);
  }
  EXPECT_TRUE(larger(a, a).isApprox(a, 1e-12));
  EXPECT_TRUE(larger(a, 0.5 * a).isApprox(a, 1e-12));
}

/// A line fitted to 40 values with Gaussian noise of 0.1, of which three are wrong by far. u = (a,
/// b), y = a + b x; the residuals are those after Huber's loss with a corner of 0.15.
struct RobustLine {
  static constexpr int kValues = 40;
  RobustLoss loss{Loss::huber, 0.15};
  Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(kValues, 0.0, 1.0), y;

  RobustLine() : y(kValues) {
    RandomStream random(4, 0);
    for (int i = 0; i < kValues; ++i) y[i] = 0.4 + 0.3 * x[i] + 0.1 * random.normal();
    for (const int i : {3, 20, 31}) y[i] += i == 20 ? -4.0 : 3.0;
  }
  Evaluated at(double a, double b) const {
    Evaluated one(Eigen::VectorXd(kValues), Eigen::MatrixXd(kValues, 2));
    for (int i = 0; i < kValues; ++i) {
      const double d = a + b * x[i] - y[i], slope = loss.slope(d);
      one.r[i] = loss(d);
      one.J.row(i) << slope, slope * x[i];
    }
    return one;
  }
  /// Returns the minimum of S by Newton's method.
  Eigen::Vector2d least() const {
    Eigen::Vector2d u(0.4, 0.3);
    for (int k = 0; k < 200; ++k) {
      const Evaluated one = at(u[0], u[1]);
      u -= (one.J.transpose() * one.J).inverse() * (one.J.transpose() * one.r);
    }
    return u;
  }
  ConfidenceOptions options() const {
    return {.traits = {.losses = std::vector<RobustLoss>(kValues, loss)}};
  }
};

TEST(RobustRows, ProfilesEndWhereTheIntervalsDo) {
  const RobustLine line;
  const Eigen::Vector2d u = line.least();
  const DesignSpace space({{.name = "a"}, {.name = "b"}});
  for (const bool with_slopes : {true, false}) {
    Identification identification(space, DesignPoint{{u[0], u[1]}}, {.confidence = line.options()});
    while (!identification.wanted().empty()) {
      std::vector<Result<Evaluated>> outcomes;
      for (const DesignPoint& p : identification.wanted()) {
        Evaluated one = line.at(p.values[0], p.values[1]);
        outcomes.emplace_back(with_slopes ? one : Evaluated(one.r));
      }
      identification.observe(outcomes);
    }
    ASSERT_TRUE(identification.status().ok());
    const Confidence& c = identification.confidence();
    EXPECT_GE(c.beyond, 3);
    EXPECT_EQ(c.with_loss, RobustLine::kValues);
    for (const TargetProfile& profile : identification.profiles()) {
      const Interval& own = c.intervals[static_cast<size_t>(profile.variable)];
      EXPECT_EQ(profile.verdict, Verdict::identifiable);
      const double width = own.upper - own.lower;
      EXPECT_NEAR(profile.interval.upper - profile.interval.lower, width, 0.1 * width);
      EXPECT_LT(width, 0.6);  // expected half width: 40 values with a noise of 0.1
    }
  }
}

// Values whose neighbors share their noise contain less information, with a loss as without one.
TEST(RobustRows, SharedNoiseWidensTheIntervals) {
  RobustLine line;
  RandomStream random(9, 0);
  double noise = 0.0;
  for (int i = 0; i < RobustLine::kValues; ++i) {
    noise = 0.85 * noise + 0.05 * random.normal();
    line.y[i] = 0.4 + 0.3 * line.x[i] + noise;
  }
  const Eigen::Vector2d u = line.least();
  const Evaluated one = line.at(u[0], u[1]);
  ConfidenceOptions shared = line.options();
  shared.traits.curves.assign(RobustLine::kValues, 0);
  const Linearization at{u, one.r, one.J, true};
  const Confidence alone = confidence(at, line.options()), neighbors = confidence(at, shared);
  EXPECT_TRUE(neighbors.is_colored);
  for (const size_t i : {0u, 1u}) {
    const auto width = [i](const Confidence& c) {
      return c.intervals[i].upper - c.intervals[i].lower;
    };
    EXPECT_GT(width(neighbors), 1.3 * width(alone));
  }
}

// The exact values of a curve, y = 2 exp(-1.3 t) + 0.5, one of which is replaced by a wrong value.
// If the wrong value is at an end, it pulls the fit so far that the other residuals have a smooth
// pattern, which must not be taken for shared noise.
TEST(RobustRows, OneWrongValueOfAnExactCurveLeavesNarrowIntervalsWhereverItIs) {
  constexpr int m = 21;
  constexpr double kScale = 2.5;
  const Eigen::Vector3d truth(2.0, -1.3, 0.5), ranges(10.0, 5.0, 2.0);
  const auto value = [](const Eigen::Vector3d& v, double t) {
    return v[0] * std::exp(v[1] * t) + v[2];
  };
  for (const RobustLoss loss : {RobustLoss{Loss::huber, 0.01}, RobustLoss{Loss::cauchy, 0.01}}) {
    for (int wrong = 0; wrong < m; ++wrong) {
      Eigen::Vector3d v = truth;
      Linearization at{{}, Eigen::VectorXd(m), Eigen::MatrixXd(m, 3), true};
      for (int turn = 0; turn < 500; ++turn) {
        Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
        Eigen::Vector3d g = Eigen::Vector3d::Zero();
        for (int i = 0; i < m; ++i) {
          const double t = 0.2 * i, e = std::exp(v[1] * t);
          const double d = (value(v, t) - value(truth, t) - (i == wrong ? 3.0 : 0.0)) / kScale;
          const Eigen::Vector3d row = Eigen::Vector3d(e, v[0] * t * e, 1.0) / kScale;
          at.r[i] = loss(d);
          at.J.row(i) = loss.slope(d) * row.cwiseProduct(ranges);
          const double psi = loss.at(at.r[i]).psi, weight = d == 0.0 ? 1.0 : psi / d;
          A += weight * row * row.transpose();
          g += psi * row;
        }
        v -= A.inverse() * g;
      }
      at.u = v.cwiseQuotient(ranges) + Eigen::Vector3d(0.0, 1.0, 0.0);
      const Confidence c = confidence(
          at,
          {.least_noise = 1e-5,
           .traits = {.curves = std::vector(m, 0), .losses = std::vector<RobustLoss>(m, loss)}});
      EXPECT_FALSE(c.is_colored) << wrong;
      // A value beyond the corner contributes like one at the corner. Both move the fit by their
      // leverage q.
      Eigen::Matrix3d inside = Eigen::Matrix3d::Zero(), beyond = inside;
      for (int i = 0; i < m; ++i) {
        const double e = std::exp(truth[1] * 0.2 * i);
        const Eigen::Vector3d row =
            Eigen::Vector3d(e, truth[0] * 0.2 * i * e, 1.0).cwiseProduct(ranges) / kScale;
        (loss.at(at.r[i]).is_beyond ? beyond : inside) += row * row.transpose();
      }
      const Eigen::Matrix3d others = inside.inverse();
      const double q = (others * beyond).trace();
      const double felt = std::sqrt(q) + std::sqrt((1.0 + q) / (m - 3));
      for (int k = 0; k < 3; ++k) {
        const Interval& own = c.intervals[static_cast<size_t>(k)];
        const double exact = truth[k] / ranges[k] + (k == 1 ? 1.0 : 0.0);
        EXPECT_LE(own.lower, exact) << wrong << " " << k;
        EXPECT_GE(own.upper, exact) << wrong << " " << k;
        // The factor 1.5 allows for the curvature of the model and for the factor K.
        EXPECT_LT(0.5 * (own.upper - own.lower),
                  1.5 * c.t * loss.scale * felt * std::sqrt(others(k, k)))
            << wrong << " " << k;
      }
    }
  }
}

// If only a value beyond the corner depends on a variable, the variable is not determined: S has no
// curvature along it.
TEST(RobustRows, WhatOnlyAValueBeyondTheCornerShowsIsOpen) {
  Linearization at{Eigen::Vector3d::Constant(0.5), Eigen::VectorXd::Zero(8), {}};
  at.J = Eigen::MatrixXd::Zero(8, 3);
  at.J.col(0).setOnes();
  for (int i = 0; i < 8; ++i) at.J(i, 1) = 0.1 * i;
  at.J(7, 2) = 1.0;
  at.J(6, 2) = -1.0;
  const RobustLoss loss{Loss::huber, 0.01};
  for (int i = 0; i < 6; ++i) at.r[i] = 1e-4 * (i % 2 == 0 ? 1 : -1);
  for (const int i : {6, 7}) {
    at.r[i] = loss(2.0);
    at.J.row(i) *= loss.slope(2.0);
  }
  const Confidence c = confidence(at, {.traits = {.losses = std::vector<RobustLoss>(8, loss)}});
  EXPECT_EQ(c.beyond, 2);
  EXPECT_GT(c.intervals[2].upper - c.intervals[2].lower, 1e3);
  EXPECT_LT(c.intervals[1].upper - c.intervals[1].lower, 2.0);
  EXPECT_TRUE(std::isinf(c.deviation(2)));
}

// Groups of values with different corners have separate mean psi': many values beyond the corner in
// one experiment must not widen the intervals of variables that another experiment determines.
TEST(RobustRows, ALossOfOneExperimentLeavesTheOthersAsExact) {
  constexpr int m = 600;
  RandomStream random(12, 0);
  Linearization at{Eigen::Vector2d::Constant(0.5), Eigen::VectorXd(m), Eigen::MatrixXd::Zero(m, 2)};
  std::vector<RobustLoss> losses(m);
  for (int i = 0; i < m; ++i) {
    at.J(i, i < m / 2 ? 0 : 1) = 1.0;
    at.r[i] = random.normal();
    if (i < m / 2) continue;
    const RobustLoss loss{Loss::huber, 0.3};
    losses[static_cast<size_t>(i)] = loss;
    at.J.row(i) *= loss.slope(at.r[i]);
    at.r[i] = loss(at.r[i]);
  }
  const Confidence c = confidence(at, {.sigma = 1.0, .traits = {.losses = losses}});
  EXPECT_NEAR(std::sqrt(c.covariance(0, 0)), 1.0 / std::sqrt(m / 2.0), 0.05 / std::sqrt(m / 2.0));
  // The expected variance of the other variable, from N values, of which `inside` lie inside the
  // corner.
  const GaussianLoss expected = RobustLoss{Loss::huber, 0.3}.expected(1.0);
  const double N = m / 2.0, inside = N - c.beyond, mean = inside / N;
  const double limited = std::min(1.0, (1.0 - mean) / (1.0 - expected.psi_slope));
  const double psi = inside * (1.0 - (1.0 - expected.inside) * limited) + c.beyond * 0.3 * 0.3;
  const double all = (N + inside) / m;  // mean psi' of both experiments
  const double K = 1.0 + 2.0 / m * (all - all * all) / (all * all);
  const double common = K * K * psi / N / (mean * mean * N), own = psi / (inside * inside);
  EXPECT_NEAR(c.covariance(1, 1), std::max(common, own), 1e-9);
}

// If values beyond the corner change, as they may by a finer mesh or step, the minimum of S does
// not shift.
TEST(RobustRows, AChangeBeyondTheCornerDoesNotShiftTheFit) {
  const RobustLine line;
  const Eigen::Vector2d u = line.least();
  const Evaluated one = line.at(u[0], u[1]);
  const Linearization at{u, one.r, one.J, true};
  const Confidence c = confidence(at, line.options());
  Eigen::VectorXd change = Eigen::VectorXd::Zero(RobustLine::kValues);
  for (const int i : {3, 20, 31}) change[i] = 0.1;
  EXPECT_LT(shift_of(at, c.held, change, c.felt_changes).norm(), 1e-12);
  // If all results of the model are too large by 0.02, the fitted level is lower by 0.02.
  for (int i = 0; i < RobustLine::kValues; ++i) change[i] = line.loss.at(one.r[i]).slope * 0.02;
  const Eigen::VectorXd shift = shift_of(at, c.held, change, c.felt_changes);
  EXPECT_NEAR(shift[0], -0.02, 1e-10);
  EXPECT_NEAR(shift[1], 0.0, 1e-10);
}

}  // namespace
}  // namespace latsch
