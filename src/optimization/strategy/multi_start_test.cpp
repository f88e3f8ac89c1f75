// SPDX-License-Identifier: Apache-2.0
#include "optimization/strategy/multi_start.h"

#include <gtest/gtest.h>

#include <cmath>

#include "optimization/trust_region/residual_trust_region.h"

namespace latsch {
namespace {

std::unique_ptr<Optimizer> trust_region(const DesignSpace& space) {
  return std::make_unique<ResidualTrustRegion>(space);
}

/// A function with two minima: 0 at y = 4 and 48.98 at y = -0.897 [Moré, Garbow, Hillstrom 1981,
/// problem 2].
Score freudenstein_roth(const DesignPoint& point) {
  const double x = point.values[0], y = point.values[1];
  const double a = -13.0 + x + ((5.0 - y) * y - 2.0) * y;
  const double b = -29.0 + x + ((y + 1.0) * y - 14.0) * y;
  return {a * a + b * b, {a, b}};
}

TEST(MultiStart, FindsTheDeeperOfTwoBasins) {
  const DesignSpace space({{.name = "x", .lower = -20.0, .upper = 20.0, .initial = 0.5},
                           {.name = "y", .lower = -6.0, .upper = 6.0, .initial = -2.0}});
  const std::vector<DesignPoint> starts{{{0.5, -2.0}}, {{4.0, 3.5}}};
  MultiStart method(space, starts, trust_region);
  double first = INFINITY, second = INFINITY;
  for (int k = 0; k < 500 && !method.converged(); ++k) {
    const DesignPoint point = method.propose(1).front();
    EXPECT_EQ(method.propose(6).front(), point);
    const Score score = freudenstein_roth(point);
    double& best = method.run() == 1 ? first : second;
    best = std::min(best, score.value);
    method.observe(point, score);
  }
  EXPECT_TRUE(method.converged());
  EXPECT_NEAR(first, 48.98, 0.05);
  EXPECT_LT(second, 1e-3);
}

TEST(MultiStart, RefusesStartsThatAreNone) {
  const DesignSpace space({{.name = "x"}});
  EXPECT_THROW(MultiStart(space, {}, trust_region), InputError);
  EXPECT_THROW(MultiStart(space, {{{2.0}}}, trust_region), InputError);
}

}  // namespace
}  // namespace latsch
