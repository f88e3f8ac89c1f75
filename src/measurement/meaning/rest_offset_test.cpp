// SPDX-License-Identifier: Apache-2.0
#include "measurement/meaning/rest_offset.h"

#include <gtest/gtest.h>

#include <cmath>

namespace latsch {
namespace {

/// Returns a K&C table in which toe is a linear function and camber a curved function of the loads
/// Fy and Mz. `first` is the smallest |Fy| in steps of 1 kN; with 0 the table contains a sample at
/// rest.
Channels kc_rig(double toe, double camber, int first = 0) {
  Channel Fy{"Fy", "N", {}}, Mz{"Mz", "N m", {}}, angle{"toe", "rad", {}},
      lean{"camber", "rad", {}};
  for (int k = -4; k <= 4; ++k)
    for (const double moment : {-40.0, 0.0, 40.0}) {
      if (std::abs(k) < first) continue;
      Fy.values.push_back(1e3 * k);
      Mz.values.push_back(moment);
      angle.values.push_back(toe - 3e-7 * 1e3 * k - 1e-6 * moment);
      lean.values.push_back(camber - 6e-8 * 1e3 * k + 1e-8 * k * k * 1e3);
    }
  Channels channels;
  for (Channel* one : {&Fy, &Mz, &angle, &lean}) channels.add(std::move(*one));
  return channels;
}

TEST(RestOffset, AbsoluteAnglesAreFoundAtRest) {
  const auto offsets = offsets_at_rest(kc_rig(4e-3, -21e-3), {"toe", "camber"});
  ASSERT_EQ(offsets.size(), 2u);
  EXPECT_EQ(offsets[0].channel, "toe");
  EXPECT_NEAR(offsets[0].offset, 4e-3, 1e-12);
  EXPECT_EQ(offsets[0].samples, 1u);
  EXPECT_NEAR(offsets[1].offset, -21e-3, 1e-12);
}

TEST(RestOffset, ChangesFromRestAreNone) {
  EXPECT_TRUE(offsets_at_rest(kc_rig(0.0, 0.0), {"toe", "camber"}).empty());
  EXPECT_TRUE(offsets_at_rest(kc_rig(0.0, 0.0, 2), {"toe", "camber"}).empty());
}

// Without a sample at rest, the constant of the fitted plane is exact if the motion is linear in
// the loads.
TEST(RestOffset, IsFoundWithoutASampleAtRest) {
  const auto offsets = offsets_at_rest(kc_rig(4e-3, 0.0, 1), {"toe", "camber"});
  ASSERT_EQ(offsets.size(), 1u);
  EXPECT_NEAR(offsets[0].offset, 4e-3, 1e-12);
  EXPECT_EQ(offsets[0].samples, 0u);
}

// If a rig loads the wheel in one direction only and the table contains no sample at rest, nothing
// is known about the offset.
TEST(RestOffset, ATableOfOneStateTellsNothing) {
  Channels channels;
  channels.add({"Fy", "N", {2000.0, 2000.0, 2000.0, 2000.0}});
  channels.add({"toe", "rad", {4e-3, 4.1e-3, 4e-3, 3.9e-3}});
  EXPECT_TRUE(offsets_at_rest(channels, {"toe"}).empty());
}

TEST(RestOffset, WindowsHoldTheSamplesAtRest) {
  EXPECT_EQ(rest_windows(kc_rig(0.0, 0.0)), "{Fy = \"0 N +- 202 N\", Mz = \"0 N m +- 2.02 N m\"}");
  EXPECT_EQ(rest_windows(kc_rig(0.0, 0.0, 1)), "");
}

}  // namespace
}  // namespace latsch
