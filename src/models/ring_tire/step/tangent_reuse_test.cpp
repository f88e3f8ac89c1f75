// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/step/tangent_reuse.h"

#include <gtest/gtest.h>

#include <vector>

namespace latsch::ring_tire {
namespace {

constexpr double kAcceleration = 4e8;  // 1/s^2

/// Returns those of `steps` steps that compute a new tangent, if a held tangent costs more
/// evaluations than a new one after `lives` steps.
std::vector<int> steps_with_their_own(int steps, int lives) {
  TangentReuse reuse;
  std::vector<int> own;
  int made = 0;
  for (int step = 0; step < steps; ++step) {
    const bool held = reuse.serves(kAcceleration);
    const int age = reuse.age();
    if (held) {
      reuse.took_with_held(step - made < lives ? 3 : 4, age);
      continue;
    }
    own.push_back(step);
    made = step;
    reuse.made(kAcceleration);
    reuse.took_with_own(3);
  }
  return own;
}

TEST(TangentReuse, HoldsATangentAsLongAsItSavesWork) {
  EXPECT_EQ(steps_with_their_own(12, 4), (std::vector<int>{0, 5, 10}));
  EXPECT_EQ(steps_with_their_own(5, 100), (std::vector<int>{0}));
}

// A held tangent is tried after 1, 3, 7, 15 and 31 steps, and every 32 from there on.
TEST(TangentReuse, IsTriedEverMoreRarelyWhereItNeverServes) {
  const int own = static_cast<int>(steps_with_their_own(1000, 1).size());
  EXPECT_GE(own, 960);
  EXPECT_LT(own, 1000);
}

TEST(TangentReuse, ServesNoStepOfAnotherLength) {
  TangentReuse reuse;
  reuse.made(kAcceleration);
  reuse.took_with_own(3);
  EXPECT_TRUE(reuse.serves(kAcceleration));
  EXPECT_FALSE(reuse.serves(4.0 * kAcceleration));
}

}  // namespace
}  // namespace latsch::ring_tire
