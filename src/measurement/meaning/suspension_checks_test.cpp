// SPDX-License-Identifier: Apache-2.0
#include "measurement/meaning/suspension_checks.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <string>

namespace latsch {
namespace {

/// Signs by which the columns of a table are multiplied; +1 for a column that is not listed.
using Flips = std::map<std::string, double>;

/// Returns the table of a linear corner on a K&C rig in iso axes; `side` is +1 for a left wheel.
/// The rotation about z is 1e-4 Mz. The one about x is -1e-6 Fy R, where the contact patch is R
/// below the middle of the carrier, so the top moves against Fy. The one about y is -1e-6 Fx R. The
/// four loads are varied one after the other.
Channels kc_table(int side, const Flips& flips = {}, const std::string& end = "") {
  std::map<std::string, std::vector<double>> table;
  const auto add = [&](double Fx, double Fy, double Fz, double Mz) {
    constexpr double R = 0.3;  // m
    const double about_z = 1e-4 * Mz + 1e-7 * Fx, about_x = 1e-6 * R * Fy + 1e-8 * Fz,
                 about_y = -1e-6 * R * Fx;
    const std::map<std::string, double> row = {{"Fx", Fx},
                                               {"Fy", Fy},
                                               {"Fz", Fz},
                                               {"Mz", Mz},
                                               {"dx", 1e-7 * Fx},
                                               {"dy", 1e-7 * Fy},
                                               {"dz", 1e-6 * Fz},
                                               {"toe", -side * about_z},
                                               {"steer", about_z},
                                               {"camber", -side * about_x},
                                               {"caster", -about_y}};
    for (const auto& [name, value] : row) {
      const auto flip = flips.find(name);
      table[name].push_back(flip == flips.end() ? value : flip->second * value);
    }
  };
  for (int i = -4; i <= 4; ++i) {
    const double t = i / 4.0;
    add(0, 0, 2000 + 2000 * t, 0);
    add(0, 3000 * t, 2000, 0);
    add(2500 * t, 0, 2000, 0);
    add(0, 0, 2000, 150 * t);
  }
  const std::map<std::string, std::string> units = {{"Fx", "N"},
                                                    {"Fy", "N"},
                                                    {"Fz", "N"},
                                                    {"Mz", "N m"},
                                                    {"dx", "m"},
                                                    {"dy", "m"},
                                                    {"dz", "m"},
                                                    {"toe", "rad"},
                                                    {"steer", "rad"},
                                                    {"camber", "rad"},
                                                    {"caster", "rad"}};
  Channels channels;
  for (auto& [name, values] : table) channels.add({name + end, units.at(name), values, {}});
  return channels;
}

std::string names_of_doubts(const Channels& channels) {
  std::string names;
  for (const ChannelDoubt& doubt : suspension_doubts(channels))
    names += (names.empty() ? "" : " ") + doubt.channel;
  return names;
}

TEST(SuspensionChecks, ATableInIsoIsNotDoubtedOnEitherSide) {
  EXPECT_EQ(names_of_doubts(kc_table(1)), "");
  EXPECT_EQ(names_of_doubts(kc_table(-1)), "");
  EXPECT_EQ(names_of_doubts(kc_table(1, {}, "_left")), "");
  EXPECT_EQ(names_of_doubts(kc_table(-1, {}, "_FR")), "");
}

TEST(SuspensionChecks, EverySignThatContradictsIsTold) {
  EXPECT_EQ(names_of_doubts(kc_table(1, {{"camber", -1}})), "camber");
  EXPECT_EQ(names_of_doubts(kc_table(1, {{"caster", -1}})), "caster");
  EXPECT_EQ(names_of_doubts(kc_table(1, {{"toe", -1}})), "camber");
  EXPECT_EQ(names_of_doubts(kc_table(-1, {{"toe", -1}})), "camber");
  EXPECT_EQ(names_of_doubts(kc_table(1, {{"Mz", -1}})), "steer camber");
  EXPECT_EQ(names_of_doubts(kc_table(1, {{"steer", -1}})), "steer");
  EXPECT_EQ(names_of_doubts(kc_table(1, {{"Fx", -1}, {"dx", -1}})), "caster");
  EXPECT_EQ(names_of_doubts(kc_table(1, {{"Fy", -1}, {"dy", -1}})), "camber");
}

TEST(SuspensionChecks, AxesOfAdamsAreNamed) {
  const auto doubts =
      suspension_doubts(kc_table(1, {{"Fx", -1}, {"dx", -1}, {"Fy", -1}, {"dy", -1}}));
  ASSERT_EQ(doubts.size(), 2u);
  EXPECT_NE(doubts[0].sentence.find("axes of Adams (x rearward, y to the right, z up)"),
            std::string::npos)
      << doubts[0].sentence;
  EXPECT_NE(doubts[0].sentence.find("axes = \"adams\""), std::string::npos);
  EXPECT_NE(doubts[1].sentence.find("as on a right wheel, while toe falls as Mz rises"),
            std::string::npos)
      << doubts[1].sentence;
}

TEST(SuspensionChecks, AKnownSideDecidesForEachSlope) {
  EXPECT_EQ(names_of_doubts(kc_table(-1, {}, "_left")), "toe_left camber_left");
  EXPECT_EQ(names_of_doubts(kc_table(1, {{"toe", -1}}, "_FL")), "toe_FL");
}

TEST(SuspensionChecks, ToeAndCamberTellTheSide) {
  EXPECT_EQ(side_of_wheel(kc_table(1)), 1);
  EXPECT_EQ(side_of_wheel(kc_table(-1)), -1);
  EXPECT_EQ(side_of_wheel(kc_table(1, {{"toe", -1}, {"camber", -1}})), -1);
  EXPECT_EQ(side_of_wheel(kc_table(1, {{"toe", -1}})), 0);  // the two disagree
  EXPECT_EQ(side_of_wheel(kc_table(1, {}, "_left")), 0);
  EXPECT_EQ(side_of_wheel({}), 0);
}

TEST(SuspensionChecks, ATableOfSlopesIsCheckedAlike) {
  const auto slopes = [](double toe, double camber, double caster) {
    Channels channels;
    channels.add({"toe_by_Mz", "rad/(N m)", {toe, 1.1 * toe}, {}});
    channels.add({"camber_by_Fy", "rad/N", {camber, camber}, {}});
    channels.add({"caster_by_Fx", "rad/N", {caster, caster}, {}});
    return names_of_doubts(channels);
  };
  EXPECT_EQ(slopes(-1e-4, -1e-6, 1e-6), "");
  EXPECT_EQ(slopes(1e-4, 1e-6, 1e-6), "");
  EXPECT_EQ(slopes(-1e-4, 1e-6, 1e-6), "camber_by_Fy");
  EXPECT_EQ(slopes(-1e-4, -1e-6, -1e-6), "caster_by_Fx");
}

TEST(SuspensionChecks, CamberThatRisesInBumpAndACasterBelowZeroAreHints) {
  const auto travel = [](double gain, double caster) {
    Channels channels;
    Channel travel{"travel", "m", {}, {}}, camber{"camber", "rad", {}, {}},
        kingpin{"caster", "rad", {}, {}};
    for (int i = -5; i <= 5; ++i) {
      travel.values.push_back(0.01 * i);
      camber.values.push_back(-0.01 + gain * 0.01 * i);
      kingpin.values.push_back(caster + 0.01 * i);
    }
    for (Channel* one : {&travel, &camber, &kingpin}) channels.add(std::move(*one));
    return names_of_doubts(channels);
  };
  EXPECT_EQ(travel(-0.5, 0.08), "");
  EXPECT_EQ(travel(0.5, 0.08), "camber");
  EXPECT_EQ(travel(-0.5, -0.08), "caster");
  EXPECT_EQ(travel(0.0, 0.08), "");  // a trailing arm
}

TEST(SuspensionChecks, ARollingWheelFollowsOtherLaws) {
  Channels channels = kc_table(1, {{"caster", -1}});
  channels.add({"Vx", "m/s", std::vector<double>(36, 10.0), {}});
  EXPECT_EQ(names_of_doubts(channels), "");
}

}  // namespace
}  // namespace latsch
