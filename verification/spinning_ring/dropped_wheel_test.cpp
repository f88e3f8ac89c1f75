// SPDX-License-Identifier: Apache-2.0
#include "dropped_wheel.h"

#include <gtest/gtest.h>

namespace latsch::verification {
namespace {

constexpr double kDropStep = 1e-4;  // s

TEST(DroppedWheel, MeetsTheGroundAsInCalculix) {
  const DropErrors errors = drop_errors(false, drop_wheel(false, kDropStep));
  EXPECT_LT(errors.impulse, 1e-3);
  EXPECT_LT(errors.load, 0.02);
  EXPECT_LT(errors.load_of_passages, 0.01);
}

// The nodes of CalculiX pass over the ground and those of the standing mesh do not, so loads agree
// in their means over the passage of a sector.
TEST(DroppedWheel, MeetsTheGroundWithASpinAsInCalculix) {
  const DropErrors errors = drop_errors(true, drop_wheel(true, kDropStep));
  EXPECT_LT(errors.impulse, 1e-3);
  EXPECT_LT(errors.load_of_passages, 0.05);
}

}  // namespace
}  // namespace latsch::verification
