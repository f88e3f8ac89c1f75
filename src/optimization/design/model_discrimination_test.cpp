// SPDX-License-Identifier: Apache-2.0
// Tests of designs between rivals against [Atkinson, Fedorov, Biometrika 62 (1975) 57] and
// exhaustive search.
#include "optimization/design/model_discrimination.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace latsch {
namespace {

constexpr double kRivalRange = 20.0;  // range of each coefficient of a rival

/// A curve over -1 .. 1 with a polynomial of `terms` terms as its rival.
RivalProblem polynomial_rival(int terms, double (*truth)(double)) {
  RivalProblem problem;
  problem.truth = [truth](const Eigen::VectorXd& s) {
    return Eigen::VectorXd(Eigen::VectorXd::Constant(1, truth(2.0 * s[0] - 1.0)));
  };
  problem.rival = [](const Eigen::VectorXd& s, const Eigen::VectorXd& v) {
    const double x = 2.0 * s[0] - 1.0;
    double y = 0.0;
    for (Eigen::Index k = v.size(); k-- > 0;) y = y * x + kRivalRange * (v[k] - 0.5);
    return Eigen::VectorXd(Eigen::VectorXd::Constant(1, y));
  };
  problem.start = Eigen::VectorXd::Constant(terms, 0.5);
  problem.present = 1e-9 * Eigen::MatrixXd::Identity(terms, terms);
  return problem;
}

// The best design between x^2 and a line is -1, 0 and 1 with the shares 1/4, 1/2 and 1/4: the
// deviation of x^2 from its best line, 1/2, is as large at all three.
TEST(ModelDiscrimination, AParabolaIsToldFromALineAtTheEndsAndTwiceInTheMiddle) {
  const RivalProblem problem = polynomial_rival(2, [](double x) { return x * x; });
  const auto tests = best_tests_against(problem, 4);
  std::vector<double> x;
  for (const Eigen::VectorXd& s : tests) x.push_back(2.0 * s[0] - 1.0);
  std::sort(x.begin(), x.end());
  ASSERT_EQ(x.size(), 4u);
  const double expected[] = {-1.0, 0.0, 0.0, 1.0};
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(x[k], expected[k], 2e-3);
  EXPECT_NEAR(fit_rival(problem, tests).T, 4.0 * 0.25, 1e-5);
}

// Between 4.5 - 1.5 exp(x) - 2 exp(-x) and a quadratic the best design is at -1, -0.669, 0.144 and
// 0.957 with the shares 0.253, 0.428, 0.247 and 0.072, and T of one test is 1.087e-3 (example 1).
TEST(ModelDiscrimination, TheDesignOfAtkinsonAndFedorovIsTheLimitOfManyTests) {
  const RivalProblem problem =
      polynomial_rival(3, [](double x) { return 4.5 - 1.5 * std::exp(x) - 2.0 * std::exp(-x); });
  constexpr int kTests = 40;
  const auto tests = best_tests_against(problem, kTests);
  EXPECT_NEAR(fit_rival(problem, tests).T / kTests, 1.087e-3, 0.01 * 1.087e-3);
  int left = 0, second = 0, third = 0, right = 0;
  for (const Eigen::VectorXd& s : tests) {
    const double x = 2.0 * s[0] - 1.0;
    left += std::abs(x + 1.0) < 0.03;
    second += std::abs(x + 0.669) < 0.03;
    third += std::abs(x - 0.144) < 0.03;
    right += std::abs(x - 0.957) < 0.05;
  }
  EXPECT_EQ(left + second + third + right, kTests);
  // whole tests are within one or two of the shares
  EXPECT_NEAR(left, 0.253 * kTests, 2.0);
  EXPECT_NEAR(second, 0.428 * kTests, 2.0);
  EXPECT_NEAR(third, 0.247 * kTests, 2.0);
  EXPECT_NEAR(right, 0.072 * kTests, 2.0);
}

TEST(ModelDiscrimination, KnowledgeOfTheRivalRaisesWhatItCannotFit) {
  RivalProblem problem = polynomial_rival(2, [](double x) { return x * x; });
  const auto tests = best_tests_against(problem, 4);
  const double free = fit_rival(problem, tests).T;
  problem.present *= 1e18;  // the coefficients stay at 0, so x^2 itself is left at -1 and 1
  EXPECT_NEAR(fit_rival(problem, tests).T, 2.0, 1e-4);
  EXPECT_LT(free, 1.1);
}

TEST(ModelDiscrimination, LimitsThatLeaveNothingGiveNoTests) {
  RivalProblem problem = polynomial_rival(2, [](double x) { return x * x; });
  problem.admits = [](const Eigen::VectorXd&) { return false; };
  EXPECT_TRUE(best_tests_against(problem, 3).empty());
}

}  // namespace
}  // namespace latsch
