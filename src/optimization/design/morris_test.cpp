// SPDX-License-Identifier: Apache-2.0
#include "optimization/design/morris.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace latsch {
namespace {

using Function = std::function<double(const std::vector<double>&)>;

DesignSpace cube(int n) {
  std::vector<DesignVariable> variables;
  for (int i = 0; i < n; ++i) variables.push_back({.name = fmt::format("x{}", i)});
  return DesignSpace(variables);
}

std::vector<ElementaryEffects> effects(const DesignSpace& space,
                                       const MorrisDesign& design,
                                       const Function& f) {
  std::vector<std::vector<std::optional<double>>> values;
  for (const auto& trajectory : design.trajectories) {
    values.emplace_back();
    for (const DesignPoint& point : trajectory) {
      const double y = f(point.values);
      values.back().push_back(std::isfinite(y) ? std::optional(y) : std::nullopt);
    }
  }
  return elementary_effects(space, design, values);
}

TEST(Morris, ALinearFunctionHasItsCoefficientsAsEffectsAndNoSpread) {
  const auto found =
      effects(cube(3), morris(cube(3), 5), [](const auto& x) { return 3.0 * x[0] - 2.0 * x[1]; });
  const double expected[] = {3.0, -2.0, 0.0};
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(found[i].mu, expected[i], 1e-12);
    EXPECT_NEAR(found[i].mu_star, std::abs(expected[i]), 1e-12);
    EXPECT_NEAR(found[i].sigma, 0.0, 1e-12);
    EXPECT_EQ(found[i].effects, 5);
  }
}

// With Delta = 2/3 on the levels 0, 1/3, 2/3, 1 a step joins 0 and 2/3 or 1/3 and 1. The effect of
// x^2 is x + (x + Delta): 2/3 or 4/3 with equal probability, mean 1, standard deviation 1/3. The
// effect of x0 x1 in x0 is x1: mean 1/2, mean square 7/18, standard deviation sqrt(5)/6. Means of
// 4000 independent effects lie within 4 standard errors, 0.026. |1/2 - x1| is 1/6 or 1/2, with the
// mean 1/3.
TEST(Morris, EffectsOfCurvedAndJointFunctionsAreThoseInClosedForm) {
  const auto found = effects(cube(3), morris(cube(3), 4000, 1), [](const auto& x) {
    return (x[1] - 0.5) * x[0] + x[2] * x[2];
  });
  EXPECT_NEAR(found[0].mu, 0.0, 0.026);
  EXPECT_NEAR(found[0].mu_star, 1.0 / 3.0, 0.026);
  EXPECT_NEAR(found[0].sigma, std::sqrt(5.0) / 6.0, 0.026);
  EXPECT_NEAR(found[2].mu, 1.0, 0.026);
  EXPECT_NEAR(found[2].mu_star, 1.0, 0.026);
  EXPECT_NEAR(found[2].sigma, 1.0 / 3.0, 0.026);
}

TEST(Morris, AnEffectIsTheChangeOverTheWholeRangeOfALogarithmicVariable) {
  const DesignSpace space(
      {{.name = "E", .lower = 1.0, .upper = 100.0, .initial = 10.0, .scale = Scale::logarithmic}});
  const auto found =
      effects(space, morris(space, 4), [](const auto& x) { return std::log10(x[0]); });
  EXPECT_NEAR(found[0].mu, 2.0, 1e-12);
}

TEST(Morris, AFailedEvaluationTakesItsTwoEffectsAlong) {
  const MorrisDesign design = morris(cube(2), 3);
  // A point in the middle of a trajectory.
  const std::vector<double> failed = design.trajectories[0][1].values;
  const auto found =
      effects(cube(2), design, [&](const auto& x) { return x == failed ? NAN : x[0] + x[1]; });
  EXPECT_LE(found[0].effects, 2);
  EXPECT_LE(found[1].effects, 2);
  EXPECT_NEAR(found[0].mu, 1.0, 1e-12);
}

TEST(Morris, StepsStayInsideAndThePlanHoldsEachPointOnce) {
  const DesignSpace space = cube(2);
  const MorrisDesign design = morris(space, 50);
  for (const auto& trajectory : design.trajectories) {
    EXPECT_EQ(trajectory.size(), 3u);
    for (const DesignPoint& point : trajectory) EXPECT_TRUE(space.contains(point));
  }
  // Two variables with 4 levels each have 16 different points.
  EXPECT_LE(design.plan().points.size(), 16u);
}

}  // namespace
}  // namespace latsch
