// SPDX-License-Identifier: Apache-2.0
#include "fitted_slope.h"

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

// The derivative of exp at 0 is 1. With five halvings of the step 0.1, the error of the fit is of
// the order h^10, which is below the rounding error divided by the step.
TEST(FittedSlope, IsThatOfASmoothFunctionWithinItsError) {
  const auto f = [](double h) { return std::exp(h); };
  const auto slope = fitted_slope(values(f, 0.1, 5), 1e-16);
  ASSERT_TRUE(slope);
  EXPECT_NEAR(slope->value, 1.0, 1e-12);
  EXPECT_LE(std::abs(slope->value - 1.0), slope->error);
  EXPECT_LT(slope->error, 1e-10);
}

// Noise of 1e-9 at steps around 1e-3 causes an error of 1e-6 in the slope, which the estimate
// contains.
TEST(FittedSlope, KnowsTheNoiseOfItsValues) {
  int call = 0;
  const auto f = [&](double h) { return std::exp(h) + (call++ % 3 - 1) * 1e-9; };
  const auto slope = fitted_slope(values(f, 2e-3, 5), 1e-9);
  ASSERT_TRUE(slope);
  EXPECT_LE(std::abs(slope->value - 1.0), slope->error);
  EXPECT_GT(slope->error, 3e-7);
  EXPECT_LT(slope->error, 1e-5);
}

// The functions 0.1 + h + 30 h^2 - 2000 h^3, at steps from 5e-3 on, have the curvature of
// frequencies of neighboring modes, with noise of half the stated bound. For 99 % of the 300
// functions the derivative must be as accurate as estimated.
TEST(FittedSlope, ErrorsThatAddBySquaresCoverNoiseOfTheTrials) {
  constexpr int kFunctions = 300;
  constexpr double kBound = 1e-10;
  RandomStream random(7, 0);
  int covered = 0;
  for (int i = 0; i < kFunctions; ++i) {
    const auto f = [&](double h) {
      const double smooth = 0.1 + h + 30.0 * h * h - 2000.0 * std::sin(h) * h * h;
      return smooth + 0.5 * kBound * (2.0 * random.uniform() - 1.0);
    };
    const auto slope = fitted_slope(values(f, 5e-3, 9), kBound);
    ASSERT_TRUE(slope);
    covered += std::abs(slope->value - 1.0) <= slope->error;
  }
  EXPECT_GE(covered, kFunctions * 99 / 100);
}

TEST(FittedSlope, NeedsFourSteps) {
  EXPECT_FALSE(fitted_slope(values([](double h) { return h; }, 1e-2, 3), 0.0));
}

}  // namespace
}  // namespace latsch::benchmarks
