// SPDX-License-Identifier: Apache-2.0
#include "optimization/identifiability/identification.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <functional>

#include "base/random.h"

namespace latsch {
namespace {

using Model = std::function<Eigen::VectorXd(const std::vector<double>&)>;

DesignSpace box(const std::vector<double>& found, double lower, double upper) {
  std::vector<DesignVariable> variables;
  for (double x : found) {
    variables.push_back({.name = fmt::format("x{}", variables.size()),
                         .lower = lower,
                         .upper = upper,
                         .initial = x});
  }
  return DesignSpace(variables);
}

struct Analyzed {
  Identification identification;
  int evaluations = 0;
};

Analyzed analyze(const DesignSpace& space, const Model& model, IdentificationOptions options = {}) {
  Analyzed analyzed{Identification(space, space.initial(), options)};
  while (!analyzed.identification.wanted().empty()) {
    std::vector<Result<Evaluated>> residuals;
    for (const DesignPoint& point : analyzed.identification.wanted()) {
      EXPECT_TRUE(space.contains(point));
      const Eigen::VectorXd r = model(point.values);
      residuals.push_back(r.size() > 0 ? Result<Evaluated>(r) : Failure{"no solution"});
    }
    analyzed.evaluations += static_cast<int>(residuals.size());
    analyzed.identification.observe(residuals);
  }
  return analyzed;
}

const IdentificationOptions kNoise{.confidence = {.sigma = 0.01}};

// Differences are of second order at inner points, at a bound and beside a failed point, so they
// are exact for squares.
TEST(Identification, ItsDifferencesTellTheDerivativesOfAnyOtherQuantity) {
  const DesignSpace space = box({0.5, 1.0}, 0, 1);
  const auto a = analyze(space,
                         [](const auto& x) {
                           return Eigen::VectorXd{{x[0] + x[1] - 1.5, x[0] - 0.5, x[1] - 1}};
                         },
                         {.confidence = {.sigma = 0.01}, .profiles = false});
  const double expected[] = {1.0, 4.0};
  for (int i = 0; i < 2; ++i) {
    double sum = 0.0;
    for (const auto& [point, weight] : a.identification.derivative(i)) {
      EXPECT_TRUE(space.contains(point));
      sum += weight * (point.values[0] * point.values[0] + 2 * point.values[1] * point.values[1]);
    }
    EXPECT_NEAR(sum, expected[i], 1e-9);
  }
}

// In a linear model the profile is the parabola of the linear interval, so both intervals agree.
// The root of S is exactly linear between rungs.
TEST(Identification, OfALinearModelTheProfileIsTheLinearInterval) {
  const auto a = analyze(
      box({0.5, 0.5}, 0, 1),
      [](const auto& x) {
        return Eigen::VectorXd{{x[0] + x[1] - 1, x[0] - 0.5, x[1] - 0.5, 0.5 * x[0] - 0.25}};
      },
      kNoise);
  for (int i = 0; i < 2; ++i) {
    const TargetProfile& p = a.identification.profiles()[i];
    EXPECT_EQ(p.verdict, Verdict::identifiable);
    EXPECT_NEAR(p.interval.lower, a.identification.confidence().intervals[i].lower, 1e-6);
    EXPECT_NEAR(p.interval.upper, a.identification.confidence().intervals[i].upper, 1e-6);
  }
}

// With a + b + c = 1 and residuals of a, b and a - c alone, c = 1 - a - b leaves two variables with
// J = [1 0; 0 1; 2 1], whose covariance is (J'J)^-1 s^2. No proposed point leaves the plane.
TEST(Identification, LinearEquationsLeaveTheIntervalsOfTheirPlane) {
  DesignSpace cube = box({0.4, 0.35, 0.25}, 0, 1);
  const DesignSpace space(cube.variables(),
                          {{.name = "sum", .coefficients = {1, 1, 1}, .lower = 1, .upper = 1}});
  const auto a = analyze(
      space,
      [](const auto& x) {
        return Eigen::VectorXd{{x[0] - 0.4, x[1] - 0.35, x[0] - x[2] - 0.15}};
      },
      kNoise);
  ASSERT_TRUE(a.identification.is_linearized());
  Eigen::MatrixXd J(3, 2), change(3, 2);
  J << 1, 0, 0, 1, 2, 1;
  change << 1, 0, 0, 1, -1, -1;
  const Eigen::MatrixXd C = 1e-4 * change * (J.transpose() * J).inverse() * change.transpose();
  const Confidence& c = a.identification.confidence();
  for (int i = 0; i < 3; ++i) {
    const double half = 1.959964 * std::sqrt(C(i, i));
    EXPECT_NEAR(c.intervals[i].upper - space.initial().values[i], half, 1e-6);
    EXPECT_NEAR(c.intervals[i].lower - space.initial().values[i], -half, 1e-6);
    ASSERT_EQ(a.identification.profiles().size(), 3U);
    EXPECT_NEAR(a.identification.profiles()[i].interval.upper, c.intervals[i].upper, 1e-5);
    EXPECT_NEAR(a.identification.profiles()[i].interval.lower, c.intervals[i].lower, 1e-5);
  }
  // Any other quantity, too, has the derivatives of motions within the plane: those of a b.
  Eigen::Vector3d slopes = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i)
    for (const auto& [point, weight] : a.identification.derivative(i))
      slopes[i] += weight * point.values[0] * point.values[1];
  const Eigen::Vector3d gradient(0.35, 0.4, 0.0);
  EXPECT_LT((slopes - (gradient - Eigen::Vector3d::Constant(gradient.mean()))).norm(), 1e-9);
}

// The residuals are r = (a - 0.5, b - 0.5) with a + b <= 1.02. Below a = 0.52, b is free and S = (a
// - 0.5)^2. Above it, b has to decrease, and  S = x^2 + (x - 0.02)^2  with  x = a - 0.5. The
// interval ends where S equals t^2 s^2, at the root computed below. No proposed point lies outside.
TEST(Identification, ProfilesKeepToLinearConstraints) {
  LinearConstraint sum;
  sum.name = "sum";
  sum.coefficients = {1, 1};
  sum.upper = 1.02;
  const DesignSpace space(box({0.5, 0.5}, 0, 1).variables(), {sum});
  const auto a = analyze(space,
                         [](const auto& x) {
                           return Eigen::VectorXd{{x[0] - 0.5, x[1] - 0.5}};
                         },
                         {.confidence = {.sigma = 0.1}});
  const double t2s2 = 0.03841459;
  for (const TargetProfile& p : a.identification.profiles()) {
    EXPECT_NEAR(p.interval.lower, 0.5 - std::sqrt(t2s2), 1e-3);
    EXPECT_NEAR(p.interval.upper, 0.5 + 0.01 + std::sqrt(0.5 * t2s2 - 0.0001), 1e-3);
    // The other variable may be 0.02 or less.
    EXPECT_NEAR(p.points.back().u[p.variable], 1.0, 2e-3);
  }
}

// The vertical stiffness k = 1 / (1 / x0 + 1 / x1) of two springs in series does not determine x0
// and x1: all points of a curve explain it equally.
TEST(Identification, TwoSpringsInSeriesAreFlatUntilOneIsMeasuredAlone) {
  const auto stiffness = [](double a, double b) { return a * b / (a + b); };
  const auto alone = analyze(
      box({4, 4}, 1, 100),
      [&](const auto& x) { return Eigen::VectorXd{{stiffness(x[0], x[1]) / 2 - 1}}; },
      kNoise);
  // The stiffness x0 of one spring can grow without limit, while that of the other must stay above
  // 2. So each stiffness has a lower limit but no value.
  for (const TargetProfile& p : alone.identification.profiles()) {
    EXPECT_EQ(p.verdict, Verdict::one_sided);
    EXPECT_TRUE(std::isfinite(p.interval.lower));
  }
  const auto both = analyze(
      box({4, 4}, 1, 100),
      [&](const auto& x) {
        return Eigen::VectorXd{{stiffness(x[0], x[1]) / 2 - 1, x[0] / 4 - 1}};
      },
      kNoise);
  for (const TargetProfile& p : both.identification.profiles())
    EXPECT_EQ(p.verdict, Verdict::identifiable);
}

TEST(Identification, AProductAloneLeavesBothFactorsFlat) {
  const auto a = analyze(
      box({1, 1}, 0.9, 1.1),
      [](const auto& x) { return Eigen::VectorXd{{x[0] * x[1] - 1}}; },
      kNoise);
  for (const TargetProfile& p : a.identification.profiles()) EXPECT_EQ(p.verdict, Verdict::flat);
  EXPECT_GT(a.identification.confidence().deviation(1), 1.0);
}

// Only x^2 is measured, so x = +1 and x = -1 explain the data equally.
TEST(Identification, ASignThatCannotBeSeenMakesTwoMinima) {
  const auto a = analyze(
      box({1.0, 0.3}, -1.6, 1.6),
      [](const auto& x) {
        return Eigen::VectorXd{{x[0] * x[0] - 1, x[1] - 0.3, x[0] * x[0] + x[1] - 1.3}};
      },
      kNoise);
  const TargetProfile& p = a.identification.profiles()[0];
  EXPECT_EQ(p.verdict, Verdict::several_minima);
  ASSERT_EQ(p.other_minima.size(), 1u);
  // The tolerance is half a step of the profile.
  EXPECT_NEAR(-1.6 + 3.2 * p.points[p.other_minima[0]].u[0], -1.0, 0.16);
  EXPECT_EQ(a.identification.profiles()[1].verdict, Verdict::identifiable);
}

// The sum of squares S as a function of y has a minimum near -1 and one near +1, which is higher
// by 4 / 100. With the distance of x from 0, the first minimum rises by 16 x^2 until it vanishes,
// the second one by x^2. The least S over y is therefore 0.04 + x^2 outside |x| = 0.05 and rises on
// both sides, although refits that start in the first minimum first rise and then fall.
TEST(Identification, ARiseThatGoesAwayFromBehindIsNoOtherMinimum) {
  const DesignSpace space({{.name = "x", .lower = -1, .upper = 1, .initial = 0},
                           {.name = "y", .lower = -2, .upper = 2, .initial = -1}});
  const auto a =
      analyze(space,
              [](const auto& x) {
                const double y = x[1];
                return Eigen::VectorXd{{y * y - 1, 2 * x[0] * (y - 1), 0.1 * (y + 1), x[0]}};
              },
              {.confidence = {.sigma = 0.3}});
  const TargetProfile& p = a.identification.profiles()[0];
  EXPECT_EQ(p.verdict, Verdict::identifiable);
  const double end = std::sqrt(0.09 * 1.959964 * 1.959964 - 0.04);
  EXPECT_NEAR(p.interval.lower, 0.5 - 0.5 * end, 0.01);
  EXPECT_NEAR(p.interval.upper, 0.5 + 0.5 * end, 0.01);
}

/// The response of a model like that of a drum test: two parameters of a decaying oscillation, a
/// ripple as a finite-element mesh causes it, and 120 samples with noise of 20.
Eigen::VectorXd passage(const std::vector<double>& x, int samples) {
  Eigen::VectorXd force(samples);
  for (int j = 0; j < samples; ++j) {
    const double t = 0.002 * j;
    const double ripple = 15.0 * std::sin(2.1 * x[0] + 0.7 * j) + 15.0 * std::sin(0.21 * x[1] + j);
    force[j] = 600.0 * std::exp(-0.12 * x[0] * t) * std::sin(x[1] * t) + ripple;
  }
  return force;
}

// There are 100 sets of noise, and each search has ended in one of the local minima of the ripple
// near the best point. The 95 % intervals contain the true values of both parameters in 95 of 100
// sets, within two standard errors.
TEST(Identification, IntervalsHoldTheTruthUnderRippleAndNoise) {
  constexpr int kSets = 100, kSamples = 120;
  const std::vector<double> truth{55.0, 180.0};
  const DesignSpace space({{.name = "damping", .lower = 10, .upper = 200, .initial = 98},
                           {.name = "frequency", .lower = 100, .upper = 300, .initial = 170}});
  const auto u = space.to_unit({truth});
  int held[2] = {};
  for (int set = 0; set < kSets; ++set) {
    RandomStream random(11, set);
    Eigen::VectorXd measured = passage(truth, kSamples);
    for (double& value : measured) value += 20.0 * random.normal();
    const DesignSpace started = space.starting_at(
        {{55.0 + 30.0 * random.uniform(), 180.0 + 4.0 * (random.uniform() - 0.5)}});
    const auto a =
        analyze(started,
                [&](const auto& x) -> Eigen::VectorXd { return measured - passage(x, kSamples); },
                {.profiles = false});
    for (int i = 0; i < 2; ++i) {
      const Interval& interval = a.identification.confidence().intervals[i];
      held[i] += interval.lower <= u[i] && u[i] <= interval.upper;
      EXPECT_LT(interval.upper - interval.lower, 0.5);
    }
  }
  for (const int count : held) EXPECT_GE(count, 90);
}

// A fit that ended early is continued: intervals and profiles belong to the minimum of the squares.
TEST(Identification, GoesOnToABetterPoint) {
  const DesignSpace space = box({0.2, 0.8}, 0, 1);
  const auto a = analyze(
      space,
      [](const auto& x) {
        return Eigen::VectorXd{{std::exp(x[0]) - std::exp(0.5), x[0] * x[1] - 0.3, x[1] - 0.6}};
      },
      kNoise);
  const double least[2] = {0.5, 0.6};
  // A tenth of the threshold changes an interval by a third of half its width.
  for (int i = 0; i < 2; ++i) {
    const Interval& interval = a.identification.confidence().intervals[i];
    EXPECT_NEAR(a.identification.center().values[i],
                least[i],
                std::sqrt(0.1) * 0.5 * (interval.upper - interval.lower));
  }
  const TargetProfile& p = a.identification.profiles()[0];
  EXPECT_LT(p.interval.lower, a.identification.center().values[0]);
  EXPECT_GT(p.interval.upper, a.identification.center().values[0]);
}

// Rosenbrock's valley as residuals, 10 (x1 - x0^2) and 1 - x0, is curved, so the other variable has
// to be refitted along it. On the profile of x0, x1 is x0^2 everywhere, so S = (1 - x0)^2.
TEST(Identification, FollowsACurvedValley) {
  const auto a = analyze(box({1, 1}, -2, 2),
                         [](const auto& x) {
                           return Eigen::VectorXd{{10 * (x[1] - x[0] * x[0]), 1 - x[0]}};
                         },
                         {.confidence = {.sigma = 0.1}});
  for (const ProfilePoint& p : a.identification.profiles()[0].points) {
    const double x0 = -2 + 4 * p.u[0];
    if (x0 * x0 > 2.0) continue;  // beyond this x0, x1 is at its bound
    EXPECT_NEAR(p.S, (1 - x0) * (1 - x0), 0.02 * 0.04 + 0.01 * p.S);
  }
  EXPECT_EQ(a.identification.profiles()[0].verdict, Verdict::identifiable);
  EXPECT_LT(a.evaluations, 250);
}

TEST(Identification, RefitsAPointThatIsNotTheLeast) {
  const auto a = analyze(
      box({0.4, 0.7}, 0, 1),
      [](const auto& x) {
        return Eigen::VectorXd{{std::exp(x[0]) - std::exp(0.5), x[0] * x[1] - 0.3, x[1] - 0.6}};
      },
      kNoise);
  EXPECT_NEAR(a.identification.refitted().u[0], 0.5, 1e-3);
  EXPECT_NEAR(a.identification.refitted().u[1], 0.6, 1e-3);
}

// The data determine x only weakly, and the model fails from x = 0.7 on, so nothing proves that
// larger values of x would fit.
TEST(Identification, WhereTheModelFailsAProfileIsNotEvaluableRatherThanFlat) {
  const auto a = analyze(
      box({0.5}, 0, 1),
      [](const auto& x) {
        if (x[0] > 0.7) return Eigen::VectorXd();
        return Eigen::VectorXd{{0.01 * (x[0] - 0.5), 0.02 * (x[0] - 0.5)}};
      },
      kNoise);
  const TargetProfile& p = a.identification.profiles()[0];
  EXPECT_EQ(p.verdict, Verdict::not_evaluable);
  EXPECT_GT(p.points.back().u[0], 0.68);  // the limit at which the model fails is located
}

// A failure beyond the end of the interval changes nothing.
TEST(Identification, AFailureBeyondTheIntervalLeavesItIdentifiable) {
  const auto a = analyze(
      box({0.5}, 0, 1),
      [](const auto& x) {
        if (x[0] > 0.53) return Eigen::VectorXd();
        return Eigen::VectorXd{{x[0] - 0.5}};
      },
      kNoise);
  const TargetProfile& p = a.identification.profiles()[0];
  EXPECT_EQ(p.verdict, Verdict::identifiable);
  EXPECT_NEAR(p.interval.upper, 0.5 + 1.959964 * 0.01, 1e-4);
}

// The residual is r = (exp(20 (x - 0.5)) - 1) / 100 with noise 1. S stays below t^2 up to x = 0.5 +
// ln(100 t + 1) / 20 and jumps far above it within one step of the profile, a tenth of the range.
TEST(Identification, FindsTheEndOfAnIntervalBehindWhichSLeaps) {
  const auto a = analyze(
      box({0.5}, 0, 1),
      [](const auto& x) { return Eigen::VectorXd{{(std::exp(20 * (x[0] - 0.5)) - 1) / 100}}; },
      {.confidence = {.sigma = 1.0}});
  const double end = 0.5 + std::log(100 * 1.959964 + 1) / 20;
  EXPECT_NEAR(a.identification.profiles()[0].interval.upper, end, 0.006);
  EXPECT_EQ(a.identification.profiles()[0].verdict, Verdict::one_sided);
}

// If the model is fitted to its own results, all residuals are zero, and no spread can be estimated
// from them.
TEST(Identification, OfAPerfectFitIsIdentifiableWithAWidthOfRounding) {
  const auto a = analyze(box({0.5, 0.5}, 0, 1), [](const auto& x) {
    return Eigen::VectorXd{{x[0] - 0.5, x[1] - 0.5, x[0] * x[1] - 0.25}};
  });
  for (const TargetProfile& p : a.identification.profiles()) {
    EXPECT_EQ(p.verdict, Verdict::identifiable);
    EXPECT_GT(p.threshold, 0.0);
    EXPECT_NEAR(p.interval.upper, 0.5, 1e-6);
  }
}

// The start lies in a valley along x0 + x1 + x2, 30 standard deviations away from its minimum. No
// step in a single variable leads along the valley. A step computed from the derivatives does; it
// needs one more trial and two for each variable.
TEST(Identification, TheShortFormGoesWhereItsDerivativesPromiseMore) {
  const auto a = analyze(box({0.5, 0.5, 0.5}, 0, 1),
                         [](const auto& x) {
                           return Eigen::VectorXd{{x[0] + x[1] + x[2] - 1.35,
                                                   40 * (x[0] - x[1]),
                                                   40 * (x[1] - x[2]),
                                                   0.1 * (x[0] - 0.45)}};
                         },
                         {.confidence = {.sigma = 0.005}, .profiles = false});
  const Confidence& c = a.identification.confidence();
  EXPECT_LT(c.left_to_gain, 1e-3 * c.threshold());
  for (const double x : a.identification.center().values) EXPECT_NEAR(x, 0.45, 1e-6);
  EXPECT_LE(a.evaluations, 2 * (1 + 2 * 3) + 8);
}

TEST(Identification, SaysWhyItCannotBegin) {
  const auto a = analyze(box({0.5}, 0, 1), [](const auto&) { return Eigen::VectorXd(); });
  ASSERT_FALSE(a.identification.status().ok());
  EXPECT_NE(a.identification.status().failure().reason.find("no solution"), std::string::npos);
}

TEST(Identification, TheShortFormCostsTwoEvaluationsAVariable) {
  const auto a = analyze(
      box({0.5, 0.5, 0.5}, 0, 1),
      [](const auto& x) {
        return Eigen::VectorXd{{x[0] - 0.5, x[1] - 0.5, x[2] - 0.5, x[0] + x[1] - 1, x[2] - x[0]}};
      },
      {.confidence = {.sigma = 0.001}, .profiles = false});
  EXPECT_EQ(a.evaluations, 1 + 2 * 3);
}

}  // namespace
}  // namespace latsch
