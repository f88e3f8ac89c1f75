// SPDX-License-Identifier: Apache-2.0
#include "optimization/identifiability/residual_noise.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
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

void expect_same(const ResidualNoise& one, const ResidualNoise& other) {
  EXPECT_EQ(one.freedom(), other.freedom());
  EXPECT_EQ(one.is_white(), other.is_white());
  EXPECT_NEAR(one.sigma(), other.sigma(), 1e-6 * other.sigma());
  EXPECT_TRUE(one.effective_deviations().isApprox(other.effective_deviations(), 1e-4));
}

// The deviance of a count of values that is not that of the determinant's columns falls forever
// toward slower noise: half of all curves of white noise then counted as noise of any level.
TEST(ResidualNoise, AVariableWithoutEffectOfItsOwnChangesNothing) {
  for (int set = 0; set < 30; ++set) {
    const Eigen::VectorXd e = slow_noise(set % 3 * 0.4, RandomStream(21, set));
    const ResidualNoise alone(e, level_and_slope(), one_curve());
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(kSamplesOfCurve, 5);
    J.leftCols(2) = level_and_slope();
    J.col(3) = 3.0 * J.col(0) - J.col(1);  // the others are flat
    expect_same(ResidualNoise(e, J, one_curve()), alone);
  }
}

TEST(ResidualNoise, IsTheSameWhetherAnUnknownIsSolvedOrSearched) {
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(kSamplesOfCurve, 0.0, 5.0);
  Eigen::MatrixXd A(kSamplesOfCurve, 4);
  A << Eigen::VectorXd::Ones(kSamplesOfCurve), t.array().sin(), t.array().cos(), t.array().square();
  const Eigen::MatrixXd basis =
      A.householderQr().householderQ() * Eigen::MatrixXd::Identity(kSamplesOfCurve, 4);
  const auto removed = [&](const Eigen::MatrixXd& Y) {
    return Eigen::MatrixXd(Y - basis * (basis.transpose() * Y));
  };
  Eigen::MatrixXd J(kSamplesOfCurve, 2);
  J << (-t).array().exp(), (-t).array().exp() * t.array();
  Eigen::MatrixXd both(kSamplesOfCurve, 6);
  both << J, A;
  int white = 0;
  for (int set = 0; set < 30; ++set) {
    const Eigen::VectorXd e = slow_noise(set % 3 * 0.4, RandomStream(22, set));
    ResidualTraits traits = one_curve();
    for (const auto& column : A.colwise()) traits.solved.emplace_back(column);
    const ResidualNoise solved(removed(e), removed(J), traits);
    expect_same(solved, ResidualNoise(removed(e), both, one_curve()));
    white += set % 3 == 0 && solved.is_white();
  }
  EXPECT_GE(white, 6) << "of ten curves of white noise";
}

TEST(ResidualTraits, OfSomeRowsKeepWhatWasSolved) {
  ResidualTraits traits = one_curve();
  traits.solved = {level_and_slope().col(1)};
  const ResidualTraits some = traits.of({3, 7});
  ASSERT_EQ(some.solved.size(), 1U);
  EXPECT_EQ(some.solved[0], Eigen::Vector2d(3.0, 7.0) / (kSamplesOfCurve - 1.0));
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
