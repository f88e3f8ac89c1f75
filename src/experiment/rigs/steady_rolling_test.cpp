// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/steady_rolling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace latsch::experiment {
namespace {

TEST(SteadyRolling, WhatIsLeftOfAnExponentialIsExact) {
  const std::size_t turn = 200;
  for (const double sigma : {0.05, 0.3, 1.0, 4.0}) {  // σ as a share of a turn
    std::vector<double> values;
    for (std::size_t i = 0; i < 3 * turn; ++i)
      values.push_back(5.0 - 3.0 * std::exp(-static_cast<double>(i) / (sigma * turn)));
    double left = 0.0;
    for (std::size_t i = 2 * turn; i < 3 * turn; ++i) left += (5.0 - values[i]) / turn;
    EXPECT_NEAR(left_to_limit(values, turn), left, 1e-9 * left + 1e-13) << sigma;
  }
}

TEST(SteadyRolling, AVariationWithinTheTurnIsNoApproach) {
  const std::size_t turn = 200;
  std::vector<double> values;
  for (std::size_t i = 0; i < 2 * turn; ++i)
    values.push_back(100.0 + 30.0 * std::sin(2.0 * std::numbers::pi * 3.0 * i / turn));
  EXPECT_LT(left_to_limit(values, turn), 1e-10);
}

TEST(SteadyRolling, ARangeThatStaysHasSettledAndOneThatFallsHasNot) {
  FallingRange swing, ripple;
  int stretches = 0;
  for (bool settled = false; !settled; ++stretches) {
    ASSERT_LT(stretches, 100);
    for (int i = 0; i < 50; ++i) {
      const double x = stretches + i / 50.0;
      swing.add(100.0 * std::exp(-0.5 * x) * std::sin(40.0 * x));
      ripple.add(3.0 * std::sin(2.0 * std::numbers::pi * x));
    }
    const bool is_ripple = ripple.has_settled(0.02, 0.0);
    EXPECT_EQ(is_ripple, stretches > 2);
    settled = swing.has_settled(0.02, 0.1);
  }
  EXPECT_LT(200.0 * std::exp(-0.5 * stretches), 0.5);
}

}  // namespace
}  // namespace latsch::experiment
