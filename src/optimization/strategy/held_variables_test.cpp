// SPDX-License-Identifier: Apache-2.0
#include "optimization/strategy/held_variables.h"

#include <gtest/gtest.h>

#include <cmath>

#include "optimization/least_squares/levenberg_marquardt.h"
#include "optimization/trust_region/residual_trust_region.h"

namespace latsch {
namespace {

/// Returns the residuals r = (x - 1, y - 2, z - 3 x y) and their Jacobian.
Score product(const DesignPoint& p) {
  const double x = p.values[0], y = p.values[1], z = p.values[2];
  Score score;
  score.residuals = {x - 1.0, y - 2.0, z - 3.0 * x * y};
  for (const double r : score.residuals) score.value += r * r;
  score.jacobian = {1, 0, 0, 0, 1, 0, -3 * y, -3 * x, 1};
  return score;
}

DesignSpace three(std::vector<LinearConstraint> constraints = {}) {
  const auto variable = [](const char* name, double initial) {
    return DesignVariable{.name = name, .lower = -10.0, .upper = 10.0, .initial = initial};
  };
  return DesignSpace({variable("x", 0.5), variable("y", 0.5), variable("z", 4.0)},
                     std::move(constraints));
}

DesignPoint searched(HeldVariables& search) {
  DesignPoint best;
  double least = INFINITY;
  for (int i = 0; i < 500 && !search.converged(); ++i) {
    const DesignPoint point = search.propose(1).front();
    const Score score = product(point);
    if (score.value < least) best = point;
    least = std::min(least, score.value);
    search.observe(point, score);
  }
  EXPECT_TRUE(search.converged());
  return best;
}

std::unique_ptr<Optimizer> by_slopes(const DesignSpace& space) {
  return std::make_unique<LevenbergMarquardt>(space);
}

// With y held at 1/2, the minimum of (x - 1)^2 + (z - 1.5 x)^2 is at x = 1, z = 1.5.
TEST(HeldVariables, StayWhereTheyAreToTheLastBit) {
  for (const bool has_slopes : {true, false}) {
    HeldVariables search(three(), {0, 2}, [&](const DesignSpace& space) {
      return has_slopes ? by_slopes(space) : std::make_unique<ResidualTrustRegion>(space);
    });
    const DesignPoint best = searched(search);
    EXPECT_EQ(best.values[1], 0.5);
    EXPECT_NEAR(best.values[0], 1.0, 1e-4);
    EXPECT_NEAR(best.values[2], 1.5, 1e-4);
  }
}

// With y = 1/2, x + 2 y + z <= 5 leaves x + z <= 4. x + z <= 2.2 is active: on z = 2.2 - x the
// minimum of (x - 1)^2 + (2.2 - 2.5 x)^2 is at x = 6.5 / 7.25.
TEST(HeldVariables, KeepToLinearConstraints) {
  const LinearConstraint all{.name = "sum", .coefficients = {1, 2, 1}, .upper = 3.2};
  DesignSpace space = three({{.name = "sum", .coefficients = {1, 2, 1}, .upper = 5.5}});
  EXPECT_EQ(free_part(space, {0, 2}).constraints().front().upper, 4.5);
  EXPECT_TRUE(free_part(three({{.name = "y", .coefficients = {0, 1, 0}, .upper = 5.0}}), {0, 2})
                  .constraints()
                  .empty());
  std::vector<DesignVariable> variables = three().variables();
  variables[2].initial = 1.0;
  HeldVariables search(DesignSpace(variables, {all}), {0, 2}, by_slopes);
  const DesignPoint best = searched(search);
  EXPECT_NEAR(best.values[0], 6.5 / 7.25, 1e-5);
  EXPECT_NEAR(best.values[2], 2.2 - 6.5 / 7.25, 1e-5);
}

TEST(HeldVariables, PointsWithOthersAreNotTheirs) {
  HeldVariables search(three(), {0, 2}, by_slopes);
  const auto before = search.propose(1);
  // A perfect point whose y differs from the held value.
  search.observe({{1.0, 2.0, 6.0}}, product({{1.0, 2.0, 6.0}}));
  EXPECT_EQ(search.propose(1).front().bits(), before.front().bits());
  EXPECT_NEAR(searched(search).values[2], 1.5, 1e-4);
}

}  // namespace
}  // namespace latsch
