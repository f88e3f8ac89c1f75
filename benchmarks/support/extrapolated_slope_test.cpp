// SPDX-License-Identifier: Apache-2.0
#include "extrapolated_slope.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/random.h"

namespace latsch::benchmarks {
namespace {

std::vector<StepValues> values(const std::function<double(double)>& f, double first, int count) {
  std::vector<StepValues> all;
  for (int k = 0; k < count; ++k) {
    const double h = std::ldexp(first, -k);
    all.push_back({h, f(-h), f(h)});
  }
  return all;
}

// exp'(0) = 1; five halvings of 0.1 leave h^10 of it, below rounding over the step.
TEST(ExtrapolatedSlope, IsThatOfASmoothFunctionWithinItsError) {
  const auto f = [](double h) { return std::exp(h); };
  const auto slope = extrapolated_slope(values(f, 0.1, 5), 1.0, 1e-16);
  ASSERT_TRUE(slope);
  EXPECT_FALSE(slope->one_sided);
  EXPECT_NEAR(slope->value, 1.0, 1e-12);
  EXPECT_LE(std::abs(slope->value - 1.0), slope->error);
  EXPECT_LT(slope->error, 1e-10);
}

// Noise of 1e-9 at steps around 1e-3 makes 1e-6 of the slope, and the estimate says so.
TEST(ExtrapolatedSlope, KnowsTheNoiseOfItsValues) {
  int call = 0;
  const auto f = [&](double h) { return std::exp(h) + (call++ % 3 - 1) * 1e-9; };
  const auto slope = extrapolated_slope(values(f, 2e-3, 5), 1.0, 1e-9);
  ASSERT_TRUE(slope);
  EXPECT_LE(std::abs(slope->value - 1.0), slope->error);
  EXPECT_GT(slope->error, 3e-7);
  EXPECT_LT(slope->error, 1e-5);
}

// |h| + h^2 has the slope 1 to the right of its kink.
TEST(ExtrapolatedSlope, IsThatOfTheSideThatIsKnown) {
  auto steps = values([](double h) { return std::abs(h) + h * h; }, 1e-2, 5);
  for (StepValues& step : steps) step.below.reset();
  const auto slope = extrapolated_slope(steps, 0.0, 1e-18);
  ASSERT_TRUE(slope);
  EXPECT_TRUE(slope->one_sided);
  EXPECT_NEAR(slope->value, 1.0, 1e-12);
}

// To the right of 1e-4 another branch: eight steps to the left and two to the right. Differences of
// the left alone, extrapolated by halved steps, know the slope to 2.7e-7 for a noise of 3e-11.
TEST(ExtrapolatedSlope, TakesWhatThereIsOfTheOtherSide) {
  int call = 0;
  const auto f = [&](double h) { return std::exp(h) + (call++ * 7 % 5 - 2) * 1.5e-11; };
  auto steps = values(f, 8e-3, 8);
  for (StepValues& step : steps) {
    if (step.step > 1.3e-4) step.above.reset();
  }
  const auto slope = extrapolated_slope(steps, 1.0, 3e-11);
  ASSERT_TRUE(slope);
  EXPECT_TRUE(slope->one_sided);
  EXPECT_LE(std::abs(slope->value - 1.0), slope->error);
  EXPECT_LT(slope->error, 1e-7);
}

// Of 300 functions that bend as modes near each other do, with noise of half the bound stated, 99
// of a hundred slopes are known as well as is said: in 0.1 + h + 30 h^2 - 2000 h^3 at steps from
// 5e-3 on.
TEST(ExtrapolatedSlope, ErrorsThatAddBySquaresCoverNoiseOfTheTrials) {
  constexpr int kFunctions = 300;
  constexpr double kBound = 1e-10;
  RandomStream random(7, 0);
  int covered = 0;
  for (int i = 0; i < kFunctions; ++i) {
    const auto f = [&](double h) {
      const double smooth = 0.1 + h + 30.0 * h * h - 2000.0 * std::sin(h) * h * h;
      return smooth + 0.5 * kBound * (2.0 * random.uniform() - 1.0);
    };
    const double at = f(0.0);
    const auto slope = extrapolated_slope(values(f, 5e-3, 9), at, kBound);
    ASSERT_TRUE(slope);
    covered += std::abs(slope->value - 1.0) <= slope->error;
  }
  EXPECT_GE(covered, kFunctions * 99 / 100);
}

// Of the same functions, from 32 values as near as the table's widest step.
TEST(FittedSlope, ScatterTellsTheNoiseAndTheErrorCoversIt) {
  constexpr int kFunctions = 300, kValues = 32;
  constexpr double kBound = 1e-10, kReach = 5e-3;
  RandomStream random(8, 0);
  int covered = 0;
  double by_fit = 0.0, by_table = 0.0, said = 0.0, said_by_table = 0.0;
  for (int i = 0; i < kFunctions; ++i) {
    const auto f = [&](double h) {
      const double smooth = 0.1 + h + 30.0 * h * h - 2000.0 * std::sin(h) * h * h;
      return smooth + 0.5 * kBound * (2.0 * random.uniform() - 1.0);
    };
    std::vector<PlacedValue> placed;
    for (int k = 0; k < kValues; ++k) {
      const double x = kReach * (2.0 * (k + 0.5) / kValues - 1.0);
      placed.push_back({x, f(x)});
    }
    const ExtrapolatedSlope slope = fitted_slope(placed);
    covered += std::abs(slope.value - 1.0) <= slope.error;
    by_fit += std::abs(slope.value - 1.0);
    said += slope.error;
    const auto table = extrapolated_slope(values(f, kReach, 9), f(0.0), kBound);
    by_table += std::abs(table.value().value - 1.0);
    said_by_table += table->error;
  }
  EXPECT_GE(covered, kFunctions * 99 / 100);
  EXPECT_LT(by_fit, by_table);
  EXPECT_LT(said, said_by_table);
}

// With no noise what is left are the powers that no fit has: sin'(0) = 1.
TEST(FittedSlope, OfASmoothFunctionIsWithinItsError) {
  std::vector<PlacedValue> placed;
  for (int k = 0; k < 20; ++k) {
    const double x = 0.05 * (k - 9.5);
    placed.push_back({x, std::sin(x) + x * x});
  }
  const ExtrapolatedSlope slope = fitted_slope(placed);
  EXPECT_LE(std::abs(slope.value - 1.0), slope.error);
  EXPECT_LT(slope.error, 1e-8);
}

TEST(ExtrapolatedSlope, NeedsThreeSteps) {
  EXPECT_FALSE(extrapolated_slope(values([](double h) { return h; }, 1e-2, 2), 0.0, 0.0));
}

}  // namespace
}  // namespace latsch::benchmarks
