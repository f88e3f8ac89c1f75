// SPDX-License-Identifier: Apache-2.0
// Tests against designs that are known in closed form [Atkinson, Donev, Tobias, Optimum
// Experimental Designs, with SAS, 2007; Bates, Watts, Nonlinear Regression Analysis, 1988].
#include "optimization/design/continuous_design.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace latsch {
namespace {

constexpr double kPlace = 1e-3, kShare = 0.01, kRatio = 1.001;

Eigen::MatrixXd no_information(int n) { return 1e-9 * Eigen::MatrixXd::Identity(n, n); }

/// Polynomial of the second degree over -1 .. 1.
DesignProblem quadratic_problem() {
  DesignProblem problem;
  problem.rows = [](const Eigen::VectorXd& s) {
    const double x = 2.0 * s[0] - 1.0;
    return Eigen::MatrixXd(Eigen::RowVector3d(1.0, x, x * x));
  };
  problem.present = no_information(3);
  return problem;
}

/// Expects places and shares in rising order of the only setting.
void expect_design(const SharedDesign& design,
                   const std::vector<double>& places,
                   const std::vector<double>& shares) {
  ASSERT_EQ(design.places.size(), places.size());
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return design.places[a][0] < design.places[b][0];
  });
  for (std::size_t k = 0; k < places.size(); ++k) {
    EXPECT_NEAR(design.places[order[k]][0], places[k], kPlace) << k;
    EXPECT_NEAR(design.shares[order[k]], shares[k], kShare) << k;
  }
  EXPECT_LE(design.largest_ratio, kRatio);
}

TEST(ContinuousDesign, ADecayIsMeasuredAtItsStartAndAtItsTimeConstant) {
  constexpr double kA = 2.0, kK = 1.5, kEnd = 5.0 / kK;
  DesignProblem problem;
  problem.rows = [](const Eigen::VectorXd& s) {
    const double t = kEnd * s[0], e = std::exp(-kK * t);
    return Eigen::MatrixXd(Eigen::RowVector2d(e, -kA * t * e));
  };
  problem.present = no_information(2);
  expect_design(best_shares(problem), {0.0, 1.0 / kK / kEnd}, {0.5, 0.5});
}

// V x / (K + x) over 0 .. b: K b / (2 K + b) and b.
TEST(ContinuousDesign, ASaturationIsMeasuredAtItsEndAndBelowItsHalf) {
  constexpr double kV = 3.0, kK = 0.7, kB = 2.0;
  DesignProblem problem;
  problem.rows = [](const Eigen::VectorXd& s) {
    const double x = kB * s[0];
    return Eigen::MatrixXd(Eigen::RowVector2d(x / (kK + x), -kV * x / ((kK + x) * (kK + x))));
  };
  problem.present = no_information(2);
  expect_design(best_shares(problem), {kK * kB / (2.0 * kK + kB) / kB, 1.0}, {0.5, 0.5});
}

TEST(ContinuousDesign, AQuadraticHasThirdsByItsDeterminant) {
  expect_design(best_shares(quadratic_problem()), {0.0, 0.5, 1.0}, {1.0 / 3, 1.0 / 3, 1.0 / 3});
}

TEST(ContinuousDesign, AQuadraticHasAQuarterAHalfAndAQuarterByItsVariances) {
  DesignProblem problem = quadratic_problem();
  problem.W = Eigen::MatrixXd::Identity(3, 3);
  expect_design(best_shares(problem), {0.0, 0.5, 1.0}, {0.25, 0.5, 0.25});
}

// The mean of g g' over -1 .. 1 has the moments 1, 1/3 and 1/5.
TEST(ContinuousDesign, AQuadraticHasAQuarterAHalfAndAQuarterByItsPredictions) {
  DesignProblem problem = quadratic_problem();
  problem.W = (Eigen::Matrix3d() << 1, 0, 1.0 / 3, 0, 1.0 / 3, 0, 1.0 / 3, 0, 1.0 / 5).finished();
  expect_design(best_shares(problem), {0.0, 0.5, 1.0}, {0.25, 0.5, 0.25});
}

// Three points over -1 .. 1/2 are -1, the middle and 1/2, because the determinant of a quadratic
// keeps its best design if the range is scaled and moved.
TEST(ContinuousDesign, LimitsOfTheRigMoveTheDesignInside) {
  DesignProblem problem = quadratic_problem();
  problem.admits = [](const Eigen::VectorXd& s) { return s[0] <= 0.75; };
  expect_design(best_shares(problem), {0.0, 0.375, 0.75}, {1.0 / 3, 1.0 / 3, 1.0 / 3});
}

// A plane with product in two settings is measured at the four corners, a quarter each.
TEST(ContinuousDesign, TwoSettingsOfABilinearModelAreMeasuredAtTheirCorners) {
  DesignProblem problem;
  problem.settings = 2;
  problem.rows = [](const Eigen::VectorXd& s) {
    const double x = 2.0 * s[0] - 1.0, y = 2.0 * s[1] - 1.0;
    return Eigen::MatrixXd(Eigen::RowVector4d(1.0, x, y, x * y));
  };
  problem.present = no_information(4);
  const SharedDesign design = best_shares(problem);
  ASSERT_EQ(design.places.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(std::abs(design.places[k][0] - 0.5), 0.5, kPlace);
    EXPECT_NEAR(std::abs(design.places[k][1] - 0.5), 0.5, kPlace);
    EXPECT_NEAR(design.shares[k], 0.25, kShare);
  }
  EXPECT_LE(design.largest_ratio, kRatio);
}

TEST(ContinuousDesign, SixTestsOfAQuadraticAreThreePairs) {
  auto tests = best_tests(quadratic_problem(), 6);
  std::vector<double> places;
  for (const Eigen::VectorXd& s : tests) places.push_back(s[0]);
  std::sort(places.begin(), places.end());
  const std::vector<double> expected{0.0, 0.0, 0.5, 0.5, 1.0, 1.0};
  ASSERT_EQ(places.size(), expected.size());
  for (std::size_t k = 0; k < places.size(); ++k) EXPECT_NEAR(places[k], expected[k], 0.01) << k;
}

// The exact design is compared with all designs of three tests on a grid of 41 places.
TEST(ContinuousDesign, ThreeTestsBesideKnownDataAreTheBestOfAGrid) {
  DesignProblem problem = quadratic_problem();
  for (const double s : {0.9, 0.95, 1.0}) {  // known already
    const Eigen::MatrixXd J = problem.rows(Eigen::VectorXd::Constant(1, s));
    problem.present += J.transpose() * J;
  }
  double least = 1e300;
  constexpr int kGrid = 40;
  for (int a = 0; a <= kGrid; ++a)
    for (int b = a; b <= kGrid; ++b)
      for (int c = b; c <= kGrid; ++c) {
        std::vector<Eigen::VectorXd> tests;
        for (const int k : {a, b, c})
          tests.push_back(Eigen::VectorXd::Constant(1, static_cast<double>(k) / kGrid));
        least = std::min(least, design_criterion(problem, tests));
      }
  EXPECT_LE(design_criterion(problem, best_tests(problem, 3)), least * 1.0005);
}

// Draws of the rate of a decay, whose first tests are at 0 and at 1/k: the mean of ln det M over
// them, for one test at 0 and one at t, is largest at t = 1 / (mean of k).
TEST(ContinuousDesign, ADesignOverDrawsOfARateIsThatOfTheirMean) {
  const std::vector<double> rates{1.5, 2.0, 2.8};
  constexpr double kEnd = 2.0;
  DesignProblem problem;
  problem.draws = 3;
  problem.rows = [&](const Eigen::VectorXd& s) {
    const double t = kEnd * s[0];
    Eigen::MatrixXd J(1, 6);
    for (int k = 0; k < 3; ++k) {
      const double e = std::exp(-rates[static_cast<std::size_t>(k)] * t);
      J(0, 2 * k) = e;
      J(0, 2 * k + 1) = -t * e;
    }
    return J;
  };
  problem.present = no_information(2);
  const double mean = (rates[0] + rates[1] + rates[2]) / 3.0;
  expect_design(best_shares(problem), {0.0, 1.0 / mean / kEnd}, {0.5, 0.5});
  auto tests = best_tests(problem, 2);
  std::sort(tests.begin(), tests.end(), [](const auto& a, const auto& b) { return a[0] < b[0]; });
  EXPECT_NEAR(tests[0][0], 0.0, kPlace);
  EXPECT_NEAR(tests[1][0], 1.0 / mean / kEnd, 0.01);
}

TEST(ContinuousDesign, TheOrderOfGainBeginsWithTheTestThatGainsMost) {
  DesignProblem problem = quadratic_problem();
  problem.present = Eigen::MatrixXd::Identity(3, 3);
  std::vector<Eigen::VectorXd> tests;
  for (const double s : {0.5, 0.6, 1.0, 0.0}) tests.push_back(Eigen::VectorXd::Constant(1, s));
  // |g|^2 of 1, x, x^2 is 3 at the ends and less between them; after one end the other gains more
  const std::vector<int> order = order_of_gain(problem, tests);
  EXPECT_EQ(order[0], 2);
  EXPECT_EQ(order[1], 3);
  EXPECT_EQ(order.size(), 4u);
}

TEST(ContinuousDesign, NothingAdmittedGivesNoDesign) {
  DesignProblem problem = quadratic_problem();
  problem.admits = [](const Eigen::VectorXd&) { return false; };
  EXPECT_TRUE(best_shares(problem).places.empty());
  EXPECT_TRUE(best_tests(problem, 3).empty());
}

}  // namespace
}  // namespace latsch
