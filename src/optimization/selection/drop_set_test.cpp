// SPDX-License-Identifier: Apache-2.0
#include "optimization/selection/drop_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "numerics/dense/cholesky.h"
#include "numerics/dense/orthogonal_factors.h"

namespace latsch {
namespace {

struct LinearFit {
  Eigen::MatrixXd X;
  Eigen::VectorXd y, b;
  Eigen::MatrixXd C;  // with a deviation of 1

  double least_squares_without(const std::vector<int>& dropped) const {
    std::vector<int> kept;
    for (int j = 0; j < X.cols(); ++j)
      if (std::find(dropped.begin(), dropped.end(), j) == dropped.end()) kept.push_back(j);
    const Eigen::MatrixXd part = X(Eigen::all, kept);
    return (y - part * numerics::shortest_solution(part, y)).squaredNorm();
  }
};

LinearFit linear_fit_at_random() {
  RandomStream random(3, 1);
  LinearFit fit;
  fit.X.resize(60, 9);
  for (double& x : fit.X.reshaped()) x = random.normal();
  fit.X.col(1) = fit.X.col(0) + 0.1 * fit.X.col(1);  // these two act almost alike
  fit.y.resize(60);
  for (double& y : fit.y) y = random.normal();
  fit.y += 0.6 * fit.X.col(0) + 0.5 * fit.X.col(8);
  fit.b = numerics::shortest_solution(fit.X, fit.y);
  fit.C = numerics::PivotedCholesky(fit.X.transpose() * fit.X)
              .solve(Eigen::MatrixXd(Eigen::MatrixXd::Identity(9, 9)));
  return fit;
}

std::vector<std::vector<int>> singles(int n) {
  std::vector<std::vector<int>> units;
  for (int i = 0; i < n; ++i) units.push_back({i});
  return units;
}

TEST(DropSet, TheRiseIsThatOfTheSumOfSquaresOfALinearRefit) {
  const LinearFit fit = linear_fit_at_random();
  const double least = fit.least_squares_without({});
  const auto rises = single_rises(fit.b, fit.C, singles(9));
  for (int j = 0; j < 9; ++j)
    EXPECT_NEAR(rises[j], fit.least_squares_without({j}) - least, 1e-9 * least);
  const DropSet set = largest_drop_set(fit.b, fit.C, singles(9), 0.0);
  EXPECT_NEAR(set.rise, fit.least_squares_without(set.units) - least, 1e-9 * least);
}

TEST(DropSet, CoefficientsThatActAlikeAreRatedTogether) {
  const LinearFit fit = linear_fit_at_random();
  const double pair = single_rises(fit.b, fit.C, {{0, 1}})[0];
  EXPECT_NEAR(pair, fit.least_squares_without({0, 1}) - fit.least_squares_without({}), 1e-9 * pair);
  const auto alone = single_rises(fit.b, fit.C, singles(2));
  EXPECT_LT(alone[0], 3.0);
  EXPECT_LT(alone[1], 3.0);
  EXPECT_GT(pair, 20.0);
}

TEST(DropSet, HoldsAtMostAThirdAndIsTheLargestThatStaysBelow) {
  const LinearFit fit = linear_fit_at_random();
  const DropSet set = largest_drop_set(fit.b, fit.C, singles(9), 0.0);
  ASSERT_TRUE(set.stays_below);
  EXPECT_LE(set.units.size(), 3u);
  EXPECT_LT(set.rise, kRiseOfADrop * static_cast<double>(set.units.size()));
}

// With C = 1 the rises are b^2.
TEST(DropSet, WithoutASetBelowTheLimitTheLeastUnitIsNamed) {
  const Eigen::VectorXd b = (Eigen::VectorXd(6) << 3, 2, 5, 4, 6, 7).finished();
  const DropSet set = largest_drop_set(b, Eigen::MatrixXd::Identity(6, 6), singles(6), 0.0);
  EXPECT_FALSE(set.stays_below);
  EXPECT_EQ(set.units, std::vector<int>{1});
  EXPECT_DOUBLE_EQ(set.rise, 4.0);
}

// With C = 1 and a price of 20, each of the units with b^2 of 4, 9 and 16 lowers the criterion, but
// a third of six units is two.
TEST(DropSet, WithoutASetBelowTheLimitTheCriterionDecides) {
  const Eigen::VectorXd b = (Eigen::VectorXd(6) << 3, 2, 5, 4, 6, 7).finished();
  const DropSet set = largest_drop_set(b, Eigen::MatrixXd::Identity(6, 6), singles(6), 20.0);
  EXPECT_FALSE(set.stays_below);
  EXPECT_EQ(set.units, (std::vector<int>{1, 0}));
  EXPECT_DOUBLE_EQ(set.rise, 13.0);
}

TEST(DropSet, AUnitOfSeveralCoefficientsMayRiseByTwoForEach) {
  const Eigen::VectorXd b = (Eigen::VectorXd(6) << 1.3, 1.3, 5, 4, 6, 7).finished();
  const DropSet set =
      largest_drop_set(b, Eigen::MatrixXd::Identity(6, 6), {{0, 1}, {2}, {3}, {4, 5}}, 0.0);
  EXPECT_TRUE(set.stays_below);
  EXPECT_EQ(set.units, std::vector<int>{0});
  EXPECT_NEAR(set.rise, 2.0 * 1.69, 1e-12);
}

}  // namespace
}  // namespace latsch
