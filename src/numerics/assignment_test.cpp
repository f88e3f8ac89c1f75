// SPDX-License-Identifier: Apache-2.0
#include "numerics/assignment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace latsch::numerics {
namespace {

double total(const Eigen::MatrixXd& cost, const std::vector<int>& partner) {
  double sum = 0.0;
  for (size_t i = 0; i < partner.size(); ++i) {
    if (partner[i] >= 0) sum += cost(static_cast<int>(i), partner[i]);
  }
  return sum;
}

double best_of_all_permutations(const Eigen::MatrixXd& cost) {
  std::vector<int> order(cost.cols());
  std::iota(order.begin(), order.end(), 0);
  double best = std::numeric_limits<double>::infinity();
  do {
    double sum = 0.0;
    for (int i = 0; i < cost.rows(); ++i) sum += cost(i, order[i]);
    best = std::min(best, sum);
  } while (std::next_permutation(order.begin(), order.end()));
  return best;
}

TEST(Assignment, IsTheBestOfAllPermutations) {
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::MatrixXd cost = Eigen::MatrixXd::Random(4 + trial % 3, 6);
    const auto partner = assign(cost);
    EXPECT_NEAR(total(cost, partner), best_of_all_permutations(cost), 1e-12);
    const Eigen::MatrixXd turned = cost.transpose();
    EXPECT_NEAR(total(turned, assign(turned)), total(cost, partner), 1e-12);
  }
}

TEST(Assignment, PrefersTheSumToTheGreedyChoice) {
  Eigen::Matrix2d cost;
  cost << 1.0, 2.0, 1.1, 9.0;
  EXPECT_EQ(assign(cost), (std::vector<int>{1, 0}));
}

TEST(Assignment, LeavesAloneWhatMayNotBePaired) {
  Eigen::Matrix3d cost;
  cost << 5.0, kForbidden, kForbidden,  //
      1.0, kForbidden, kForbidden,      //
      kForbidden, kForbidden, 7.0;
  EXPECT_EQ(assign(cost), (std::vector<int>{-1, 0, 2}));
}

TEST(Assignment, TakesEmptyTables) {
  EXPECT_TRUE(assign(Eigen::MatrixXd(0, 3)).empty());
  EXPECT_EQ(assign(Eigen::MatrixXd(2, 0)), (std::vector<int>{-1, -1}));
}

}  // namespace
}  // namespace latsch::numerics
