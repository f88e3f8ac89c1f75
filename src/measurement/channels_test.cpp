// SPDX-License-Identifier: Apache-2.0
#include "measurement/channels.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace latsch {
namespace {

TEST(Channels, KeepTheOrderInWhichTheyWereRecorded) {
  Channels channels;
  EXPECT_TRUE(channels.empty());
  channels.add({"Fz", "N", {1.0, 2.0}});
  channels.add({"deflection", "m", {0.0, 0.001}});
  EXPECT_EQ(channels.all()[0].name, "Fz");
  EXPECT_EQ(channels.all()[1].unit, "m");
  EXPECT_EQ(channels["Fz"], (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(channels.find("Fy"), nullptr);
}

TEST(Channels, AnUnknownNameIsAnsweredWithTheNamesThereAre) {
  Channels channels;
  channels.add({"Fz", "N", {}});
  channels.add({"deflection", "m", {}});
  try {
    (void)channels["deflektion"];
    FAIL();
  } catch (const std::out_of_range& error) {
    EXPECT_STREQ(error.what(),
                 "no channel \"deflektion\", did you mean \"deflection\"? (channels: \"Fz\" or "
                 "\"deflection\")");
  }
}

}  // namespace
}  // namespace latsch
