// SPDX-License-Identifier: Apache-2.0
#include "optimization/strategy/basin_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "optimization/trust_region/residual_trust_region.h"

namespace latsch {
namespace {

using Model = std::function<Result<Score>(const DesignPoint&)>;

std::unique_ptr<Optimizer> one_minimum(const DesignSpace& space) {
  return std::make_unique<ResidualTrustRegion>(
      space, ResidualTrustRegionOptions{.restarts = 0, .tests_end = false});
}

/// A function with two minima: 0 at (5, 4) and 48.98 at (11.41, -0.897) [Moré, Garbow, Hillstrom
/// 1981, problem 2].
Result<Score> freudenstein_roth(const DesignPoint& point) {
  const double x = point.values[0], y = point.values[1];
  const double a = -13.0 + x + ((5.0 - y) * y - 2.0) * y;
  const double b = -29.0 + x + ((y + 1.0) * y - 14.0) * y;
  return Score{a * a + b * b, {a, b}};
}

DesignSpace plane(double start_x, double start_y) {
  return DesignSpace({{.name = "x", .lower = -20.0, .upper = 20.0, .initial = start_x},
                      {.name = "y", .lower = -6.0, .upper = 6.0, .initial = start_y}});
}

/// Runs the search to its end. Returns the number of trials.
int run(BasinSearch& method, const Model& model, int look_ahead = 1) {
  int trials = 0;
  while (!method.converged() && trials < 5000) {
    const DesignPoint next = method.propose(1).front();
    EXPECT_EQ(method.propose(look_ahead).front(), next);
    method.observe(next, model(next));
    ++trials;
  }
  EXPECT_TRUE(method.converged());
  EXPECT_TRUE(method.propose(3).empty());
  return trials;
}

TEST(BasinSearch, FindsBothMinimaFromAStartInTheWorseBasin) {
  BasinSearch method(plane(15.0, -2.0), {}, one_minimum);
  run(method, freudenstein_roth, 8);
  const auto basins = method.basins();
  ASSERT_GE(basins.size(), 2u) << method.ending();
  EXPECT_LT(basins[0].value, 1e-3);
  EXPECT_NEAR(basins[1].value, 48.98, 0.5);
  EXPECT_NE(method.ending().find("basins found"), std::string::npos) << method.ending();
}

TEST(BasinSearch, ClaimsItsCountsAndNamesMinimaBeforeItsEnd) {
  BasinSearch method(plane(15.0, -2.0), {}, one_minimum);
  std::size_t before = 0;
  while (!method.converged()) {
    const DesignPoint next = method.propose(1).front();
    method.observe(next, freudenstein_roth(next));
    if (!method.converged()) before = method.basins().size();
    EXPECT_EQ(method.claims().empty(), !method.converged());
  }
  EXPECT_EQ(before, 2u);
  int points = 0;
  for (const FoundBasin& basin : method.basins()) points += basin.hits;
  EXPECT_GE(points, 4);  // two minima and more than two points are needed to count
  const EndingClaim claim = method.claims().front();
  EXPECT_EQ(claim.statement, "few further minima are expected");
  for (const ClaimNumber& number : claim.numbers) {
    if (number.name == "minima found") {
      EXPECT_EQ(number.value, 2.0);
    }
    EXPECT_LE(number.value, number.at_most.value_or(1e300)) << number.name;
  }
}

// A linear model has one basin: all points belong to it, and few trials show this.
TEST(BasinSearch, EndsSoonInTheBasinOfALinearModel) {
  const Model linear = [](const DesignPoint& point) -> Result<Score> {
    const double a = point.values[0] - 3.0, b = point.values[1] + point.values[0] - 2.0;
    return Score{a * a + b * b, {a, b}};
  };
  BasinSearch method(plane(10.0, 2.0), {}, one_minimum);
  EXPECT_LE(run(method, linear), 25);
  ASSERT_EQ(method.basins().size(), 1u);
  EXPECT_GE(method.basins()[0].hits, 8);
  EXPECT_LT(method.expected_unseen(), 0.5);
}

TEST(BasinSearch, EndsWithItsBudgetAndSaysSo) {
  BasinSearch method(plane(15.0, -2.0), {.budget = 8}, one_minimum);
  EXPECT_LE(run(method, freudenstein_roth), 24);
  EXPECT_NE(method.ending().find("budget of 24 trials is spent"), std::string::npos)
      << method.ending();
}

// Trials that others asked for are known, and spend no budget.
TEST(BasinSearch, HasItsBudgetBesideTrialsThatWereKnownBefore) {
  BasinSearch method(plane(15.0, -2.0), {.budget = 8}, one_minimum);
  for (int k = 0; k < 60; ++k) {
    const DesignPoint point{{-19.0 + 0.6 * k, 5.0 - 0.15 * k}};
    method.observe(point, freudenstein_roth(point));
  }
  EXPECT_FALSE(method.converged());
  EXPECT_GE(run(method, freudenstein_roth), 10);
}

TEST(BasinSearch, TakesMoreVariablesThanTheSequenceHas) {
  std::vector<DesignVariable> variables;
  for (int i = 0; i < 25; ++i)
    variables.push_back({.name = "x" + std::to_string(i), .lower = -1.0, .initial = 0.5});
  const Model linear = [](const DesignPoint& point) -> Result<Score> {
    Score score;
    for (const double x : point.values) score.residuals.push_back(x - 0.2);
    for (const double r : score.residuals) score.value += r * r;
    return score;
  };
  BasinSearch method(DesignSpace(variables), {}, one_minimum);
  run(method, linear);
  ASSERT_EQ(method.basins().size(), 1u);
  EXPECT_LT(method.basins()[0].value, 1e-4);
}

TEST(BasinSearch, PassesPointsThatFail) {
  const Model half = [](const DesignPoint& point) -> Result<Score> {
    if (point.values[0] < 0.0) return Failure{"no outcome"};
    return freudenstein_roth(point);
  };
  BasinSearch method(plane(-15.0, -2.0), {}, one_minimum);
  run(method, half);
  ASSERT_FALSE(method.basins().empty());
  EXPECT_LT(method.basins()[0].value, 1e-3);
}

TEST(BasinSearch, EndsWhereEverythingFails) {
  BasinSearch method(plane(1.0, 1.0), {.budget = 20}, one_minimum);
  run(method, [](const DesignPoint&) -> Result<Score> { return Failure{"no outcome"}; });
  EXPECT_TRUE(method.basins().empty());
}

TEST(BasinSearch, RefusesATargetWithoutResiduals) {
  BasinSearch method(plane(1.0, 1.0), {}, one_minimum);
  EXPECT_THROW(method.observe(method.propose(1).front(), Score{1.0}), InputError);
  EXPECT_THROW(BasinSearch(plane(1.0, 1.0), {.budget = 0}, one_minimum), InputError);
}

}  // namespace
}  // namespace latsch
