// SPDX-License-Identifier: Apache-2.0
#include "optimization/design/latin_hypercube.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace latsch {
namespace {

DesignSpace cube(int n) {
  std::vector<DesignVariable> variables;
  for (int i = 0; i < n; ++i) variables.push_back({.name = fmt::format("x{}", i)});
  return DesignSpace(variables);
}

double least_distance(const SamplingPlan& plan) {
  double least = INFINITY;
  for (size_t i = 0; i < plan.points.size(); ++i) {
    for (size_t j = i + 1; j < plan.points.size(); ++j) {
      double sum = 0.0;
      for (size_t v = 0; v < plan.points[i].values.size(); ++v) {
        sum += std::pow(plan.points[i].values[v] - plan.points[j].values[v], 2);
      }
      least = std::min(least, std::sqrt(sum));
    }
  }
  return least;
}

TEST(LatinHypercube, HoldsEveryShareOfEveryVariableOnce) {
  const SamplingPlan plan = latin_hypercube(cube(5), 23, 7);
  for (int v = 0; v < 5; ++v) {
    std::vector<double> values;
    for (const DesignPoint& point : plan.points) values.push_back(point.values[v]);
    std::sort(values.begin(), values.end());
    for (int k = 0; k < 23; ++k) EXPECT_DOUBLE_EQ(values[k], (k + 0.5) / 23);
  }
}

// The largest possible distances of the closest pair, squared and in units of a share, for 5 and 10
// points in two variables [van Dam, Husslage, den Hertog, Melissen, Operations Research 55 (2007)
// 158].
TEST(LatinHypercube, FindsTheKnownMaximinDesignsInThePlane) {
  EXPECT_NEAR(least_distance(latin_hypercube(cube(2), 5)), std::sqrt(5.0) / 5, 1e-12);
  EXPECT_NEAR(least_distance(latin_hypercube(cube(2), 10)), std::sqrt(10.0) / 10, 1e-12);
}

// If the closest pair of 30 points of a unit cube has the distance d, balls of diameter d around
// the points fit into a cube of edge 1 + d without overlap. At the densest packing, which fills pi
// / sqrt(18) of the space, d is at most 0.56. Random Latin hypercubes reach about 0.1.
TEST(LatinHypercube, KeepsPointsApart) {
  for (std::uint64_t seed : {0, 1, 2}) {
    EXPECT_GT(least_distance(latin_hypercube(cube(3), 30, seed)), 0.5 * 0.56);
  }
}

TEST(LatinHypercube, IsAFunctionOfTheSeed) {
  EXPECT_EQ(latin_hypercube(cube(3), 10, 4).points, latin_hypercube(cube(3), 10, 4).points);
  EXPECT_NE(latin_hypercube(cube(3), 10, 4).points, latin_hypercube(cube(3), 10, 5).points);
}

TEST(LatinHypercube, RejectsASinglePoint) {
  EXPECT_THROW((void)latin_hypercube(cube(2), 1), InputError);
}

}  // namespace
}  // namespace latsch
