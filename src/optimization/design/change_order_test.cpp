// SPDX-License-Identifier: Apache-2.0
// Tests of the order of tests against all permutations and against orders that are known.
#include "optimization/design/change_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "base/random.h"

namespace latsch {
namespace {

double cost_of_order(const Eigen::MatrixXd& tests,
                     const std::vector<double>& costs,
                     const std::vector<int>& order) {
  const std::vector<int> changes = setting_changes(tests, order);
  double cost = 0.0;
  for (std::size_t k = 0; k < costs.size(); ++k) cost += costs[k] * changes[k];
  return cost;
}

TEST(ChangeOrder, SixTestsAreOrderedAsCheaplyAsTheBestPermutation) {
  for (std::uint64_t set = 0; set < 20; ++set) {
    RandomStream random(3, set);
    Eigen::MatrixXd tests(6, 3);
    for (double& one : tests.reshaped()) one = std::floor(3.0 * random.uniform()) / 2.0;
    const std::vector<double> costs{20.0, 3.0, 1.0};
    std::vector<int> order(6);
    std::iota(order.begin(), order.end(), 0);
    double least = 1e300;
    do {
      least = std::min(least, cost_of_order(tests, costs, order));
    } while (std::next_permutation(order.begin(), order.end()));
    EXPECT_EQ(cost_of_order(tests, costs, order_of_few_changes(tests, costs)), least) << set;
  }
}

TEST(ChangeOrder, ADearSettingOfThirtyTestsChangesOnlyBetweenItsLevels) {
  RandomStream random(4, 1);
  Eigen::MatrixXd tests(30, 2);
  for (Eigen::Index k = 0; k < tests.rows(); ++k)
    tests.row(k) << std::floor(3.0 * random.uniform()) / 2.0, random.uniform();
  const std::vector<int> order = order_of_few_changes(tests, {100.0, 1.0});
  EXPECT_EQ(setting_changes(tests, order)[0], 2);
  std::vector<int> sorted = order;
  std::sort(sorted.begin(), sorted.end());
  for (int k = 0; k < 30; ++k) EXPECT_EQ(sorted[static_cast<std::size_t>(k)], k);
}

TEST(ChangeOrder, EqualTestsFollowEachOther) {
  Eigen::MatrixXd tests(4, 1);
  tests << 0.5, 0.1, 0.5, 0.9;
  const std::vector<int> order = order_of_few_changes(tests, {1.0});
  const auto first = std::find(order.begin(), order.end(), 0) - order.begin();
  const auto second = std::find(order.begin(), order.end(), 2) - order.begin();
  EXPECT_EQ(std::abs(first - second), 1);
}

}  // namespace
}  // namespace latsch
