// SPDX-License-Identifier: Apache-2.0
#include "correlation/doe/doe_extent.h"

#include <gtest/gtest.h>

#include <cmath>

#include "optimization/design/full_factorial.h"

namespace latsch::correlation {
namespace {

DesignSpace two_variables() {
  return DesignSpace(
      {{"a", {"a"}, 0.0, 4.0, 1.0}, {"b", {"b"}, 1.0, 100.0, 10.0, Scale::logarithmic}});
}

/// Returns the trials of a grid with an invented target.
template <class Target>
std::vector<RatedTrial> trials_of(const DesignSpace& space, Target target) {
  std::vector<RatedTrial> trials;
  for (const DesignPoint& point : full_factorial(space, {5, 5}).points)
    trials.push_back({point, target(point.values[0], std::log10(point.values[1]))});
  return trials;
}

// All points on one diagonal of the grid fulfill a + 2 log10(b) = 4.
TEST(DoeExtent, AValleyReachesThroughTheRangeOfBothVariables) {
  const DesignSpace space = two_variables();
  const auto trials = trials_of(space, [](double a, double b) { return std::abs(a + 2 * b - 4); });
  const auto found = doe_extent(space, trials, 0.1);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->points, 5);
  EXPECT_DOUBLE_EQ(found->lower.values[0], 0.0);
  EXPECT_DOUBLE_EQ(found->upper.values[1], 100.0);
  EXPECT_DOUBLE_EQ(found->share[0], 1.0);
  EXPECT_DOUBLE_EQ(found->share[1], 1.0);
}

// For a, the value 2 and its neighbors one step of 1 away are below a target of 1. For b only 10
// is, because a step is half a decade.
TEST(DoeExtent, ASingleMinimumReachesAsFarAsTheLevel) {
  const DesignSpace space = two_variables();
  const auto trials =
      trials_of(space, [](double a, double b) { return std::hypot(a - 2, 4 * (b - 1)); });
  const auto found = doe_extent(space, trials, 1.0 + 1e-9);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->points, 3);
  EXPECT_DOUBLE_EQ(found->share[0], 0.5);
  EXPECT_DOUBLE_EQ(found->share[1], 0.0);
}

TEST(DoeExtent, NoPointBelowTheLevelOrWithinTheConstraintsIsNone) {
  const DesignSpace space = two_variables();
  auto trials = trials_of(space, [](double, double) { return 1.0; });
  EXPECT_FALSE(doe_extent(space, trials, 0.5));
  for (RatedTrial& trial : trials) trial.violation = 0.1;
  EXPECT_FALSE(doe_extent(space, trials, 2.0));
}

}  // namespace
}  // namespace latsch::correlation
