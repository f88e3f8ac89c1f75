// SPDX-License-Identifier: Apache-2.0
#include "optimization/identifiability/residual_noise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "optimization/identifiability/confidence.h"

namespace latsch {
namespace {

constexpr int kSamplesOfCurve = 40;

/// Returns derivatives of a level and a slope over the samples.
Eigen::MatrixXd level_and_slope() {
  Eigen::MatrixXd J(kSamplesOfCurve, 2);
  J.col(0).setOnes();
  J.col(1) = Eigen::VectorXd::LinSpaced(kSamplesOfCurve, 0.0, 1.0);
  return J;
}

ResidualTraits one_curve() { return {.curves = std::vector<int>(kSamplesOfCurve, 0)}; }

/// Returns an autoregression of order 1 with variance 1.
Eigen::VectorXd slow_noise(double kappa, RandomStream random) {
  Eigen::VectorXd e(kSamplesOfCurve);
  e[0] = random.normal();
  for (int j = 1; j < kSamplesOfCurve; ++j)
    e[j] = kappa * e[j - 1] + std::sqrt(1.0 - kappa * kappa) * random.normal();
  return e;
}

TEST(ResidualNoise, ASmoothCurveIsAPatternEvenUnderWeakNoise) {
  for (const double waves : {1.0, 1.5, 2.5}) {
    for (const double weak : {0.0, 0.03}) {
      RandomStream random(5, 1);
      Eigen::VectorXd r(kSamplesOfCurve);
      for (int j = 0; j < kSamplesOfCurve; ++j)
        r[j] = std::sin(2.0 * M_PI * waves * j / kSamplesOfCurve) + weak * random.normal();
      const ResidualNoise noise(r, level_and_slope(), one_curve());
      EXPECT_TRUE(noise.is_pattern()) << waves << " " << weak;
      EXPECT_LE(noise.sigma(), 2.0 * r.norm() / std::sqrt(kSamplesOfCurve - 2.0) * (1.0 + 1e-12));
    }
  }
}

// A pattern with a bend at its beginning, such as what one exponential leaves of two, is smooth in
// most places.
TEST(ResidualNoise, ABendAtOnePlaceDoesNotHideAPattern) {
  Eigen::VectorXd r(kSamplesOfCurve);
  for (int j = 0; j < kSamplesOfCurve; ++j)
    r[j] = std::exp(-1.2 * j) - 0.5 * std::cos(M_PI * j / kSamplesOfCurve);
  EXPECT_TRUE(ResidualNoise(r, level_and_slope(), one_curve()).is_pattern());
}

// Slow noise has independent steps, so the differences of its differences are larger than these.
TEST(ResidualNoise, SlowNoiseIsNoPattern) {
  for (const double kappa : {0.5, 0.8, 0.95, 0.99}) {
    int patterns = 0;
    for (int set = 0; set < 50; ++set)
      patterns +=
          ResidualNoise(slow_noise(kappa, RandomStream(9, set)), level_and_slope(), one_curve())
              .is_pattern();
    EXPECT_LE(patterns, 3) << kappa;
  }
}

// The level is held at its bound, one unit below the data, and the model bends beside it. The
// intervals of the other variable follow from what remains of the misfit, and are finite.
TEST(Confidence, AMisfitThatABoundCausesLeavesTheOthersKnown) {
  Linearization at{Eigen::Vector2d(1.0, 0.5), Eigen::VectorXd(kSamplesOfCurve), level_and_slope()};
  for (int j = 0; j < kSamplesOfCurve; ++j) {
    const double x = static_cast<double>(j) / (kSamplesOfCurve - 1);
    at.r[j] = -1.0 + 1.4 * x - 0.2 * x * x * x;
  }
  const Confidence c = confidence(at, {.traits = one_curve()});
  EXPECT_EQ(c.held[0], Bound::upper);
  EXPECT_TRUE(c.is_pattern);
  EXPECT_GT(c.share_beyond_bounds, 0.9);
  const Eigen::VectorXd slope = at.J.col(1);
  const double least = at.u[1] - slope.dot(at.r) / slope.squaredNorm();
  EXPECT_LE(c.intervals[1].lower, least);
  EXPECT_GE(c.intervals[1].upper, least);
  EXPECT_LT(c.intervals[1].upper - c.intervals[1].lower, 2.0);
}

}  // namespace
}  // namespace latsch
