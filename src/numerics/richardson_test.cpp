// SPDX-License-Identifier: Apache-2.0
#include "numerics/richardson.h"

#include <gtest/gtest.h>

#include <cmath>

namespace latsch::numerics {
namespace {

TEST(Richardson, RecoversLimitAndOrderOfAPowerLaw) {
  const std::array<double, 3> h = {0.5, 1.0 / 3.0, 0.25};
  for (double p : {1.2, 2.0, 2.9}) {
    std::array<double, 3> v;
    for (int i = 0; i < 3; ++i) v[i] = 7.0 - 0.3 * std::pow(h[i], p);
    const Extrapolation e = extrapolate(h, v);
    EXPECT_TRUE(e.observed);
    EXPECT_NEAR(e.order, p, 1e-9);
    EXPECT_NEAR(e.value, 7.0, 1e-12);
  }
}

TEST(Richardson, FallsBackToTheAssumedOrderWhereValuesOscillate) {
  const Extrapolation e = extrapolate({1.0, 0.5, 0.25}, {1.0, 0.9, 1.1});
  EXPECT_FALSE(e.observed);
  EXPECT_NEAR(e.value, 1.1 + 0.2 / 3.0, 1e-12);  // (4 * 1.1 - 0.9) / 3
}

}  // namespace
}  // namespace latsch::numerics
