// SPDX-License-Identifier: Apache-2.0
#include "measurement/meaning/channel_checks.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <tuple>

namespace latsch {
namespace {

constexpr double kDegreeOfChecks = std::numbers::pi / 180.0;

/// A cornering test in iso of a linear tire: Fy = -(C alpha + G gamma) Fz, and Mz aligns the wheel.
Channels cornering() {
  Channels channels;
  Channel alpha{"alpha", "rad", {}}, gamma{"gamma", "rad", {}}, Fz{"Fz", "N", {}},
      Fy{"Fy", "N", {}}, Mz{"Mz", "N m", {}}, p{"p", "Pa", {}}, Vx{"Vx", "m/s", {}},
      omega{"omega", "rad/s", {}}, RL{"loaded_radius", "m", {}}, T{"tread_center", "K", {}};
  for (int i = -8; i <= 8; ++i)
    for (const double camber : {0.0, 2.0, 4.0}) {
      const double a = i * kDegreeOfChecks, g = camber * kDegreeOfChecks;
      alpha.values.push_back(a);
      gamma.values.push_back(g);
      Fz.values.push_back(1000.0);
      Fy.values.push_back(-1000.0 * (15.0 * a + 0.9 * g));
      Mz.values.push_back(1000.0 * 0.4 * a);
      p.values.push_back(82e3);
      Vx.values.push_back(11.0);
      omega.values.push_back(45.0);
      RL.values.push_back(0.24);
      T.values.push_back(330.0);
    }
  for (Channel* one : {&alpha, &gamma, &Fz, &Fy, &Mz, &p, &Vx, &omega, &RL, &T})
    channels.add(std::move(*one));
  return channels;
}

Channels times(const std::string& name, double factor, std::size_t every = 1) {
  const Channels good = cornering();
  Channels changed;
  for (Channel channel : good.all()) {
    for (std::size_t i = 0; i < channel.values.size(); i += every)
      if (channel.name == name) channel.values[i] *= factor;
    changed.add(std::move(channel));
  }
  return changed;
}

TEST(ChannelChecks, FindNothingInAGoodRecord) { EXPECT_TRUE(doubts_about(cornering()).empty()); }

std::string said_of_time(std::vector<double> seconds, const std::vector<std::size_t>& breaks = {}) {
  Channels channels;
  channels.add({"time", "s", std::move(seconds)});
  std::string said;
  for (const ChannelDoubt& doubt : doubts_about(channels, breaks))
    said += fmt::format("{}@{};", doubt.sentence, doubt.sample);
  return said;
}

TEST(ChannelChecks, TimeRisesFromSampleToSample) {
  EXPECT_EQ(said_of_time({0.0, 0.1, 0.2, 0.3}), "");
  EXPECT_NE(said_of_time({0.0, 0.1, 0.05, 0.3})
                .find("goes back in 1 of 4 samples, first from 0.1 to 0.05 s"),
            std::string::npos);
  EXPECT_NE(said_of_time({0.0, 0.1, 0.05, 0.3}).find("@2;"), std::string::npos);
  EXPECT_NE(said_of_time({0.0, 0.1, 0.1, 0.3}).find("repeats in 1 of 4 samples, first at 0.1 s"),
            std::string::npos);
  EXPECT_NE(said_of_time({0.3, 0.2, 0.1, 0.0}).find("sign"), std::string::npos);
  EXPECT_NE(said_of_time({0.3, 0.4, 0.5, 0.0, 0.1}).find("goes back in 1 of 5"), std::string::npos);
  EXPECT_EQ(said_of_time({0.0, 0.1, 0.0, 0.1}, {2}), "");  // the second file begins anew
}

// Test millimeters that were read as meters, such as the 0.113 mm by which a hub moves under 4 kN.
TEST(ChannelChecks, DoubtDisplacementsOfAnotherUnit) {
  for (const auto& [name, usual, other] : {std::tuple{"dy", 0.02, 0.113},
                                           {"dx", 0.02, 0.2},
                                           {"lateral displacement", 0.02, 0.113},
                                           {"dz", 0.1, 1.5},
                                           {"travel", 0.1, 5.0},
                                           {"rack", 0.05, 3.0}}) {
    Channels good, bad;
    good.add({name, "m", {-usual, 0.0, usual}});
    bad.add({name, "m", {-other, 0.0, other}});
    EXPECT_TRUE(doubts_about(good).empty()) << name;
    const auto doubts = doubts_about(bad);
    ASSERT_EQ(doubts.size(), 1u) << name;
    EXPECT_NE(doubts[0].sentence.find("is it in m, cm, mm or in?"), std::string::npos)
        << doubts[0].sentence;
  }
}

// Test a single sample that was written in kilonewtons but read as newtons, and a spike.
TEST(ChannelChecks, NoForceIsMoreThanThreeTimesTheLoad) {
  const auto doubts = doubts_about(times("Fy", 20.0, 17));
  ASSERT_FALSE(doubts.empty());
  EXPECT_EQ(doubts[0].channel, "Fy");
  EXPECT_NE(doubts[0].sentence.find("more than 3 times the load Fz"), std::string::npos)
      << doubts[0].sentence;
  EXPECT_FALSE(doubts[0].is_error);
}

TEST(ChannelChecks, RefuseLoadsThatPull) {
  const auto doubts = doubts_about(times("Fz", -1.0));
  ASSERT_EQ(doubts.size(), 1u);
  EXPECT_TRUE(doubts[0].is_error && doubts[0].all_loads_negative);
  EXPECT_EQ(doubts[0].channel, "Fz");
}

TEST(ChannelChecks, CountAMinority) {
  const auto doubts = doubts_about(times("Fz", -1.0, 17));
  ASSERT_FALSE(doubts.empty());
  EXPECT_FALSE(doubts[0].is_error);
  EXPECT_NE(doubts[0].sentence.find("in 3 of 51 samples"), std::string::npos) << doubts[0].sentence;
}

// Test every sign and every unit that is easily mistaken, one for each channel.
TEST(ChannelChecks, NameTheChannelOfAnotherSignOrUnit) {
  const struct {
    const char* channel;
    double factor;
    bool is_error;
  } cases[] = {{"Fy", -1.0, false},
               {"alpha", -1.0, false},
               {"Mz", -1.0, false},
               {"gamma", -1.0, false},
               {"omega", -1.0, false},
               {"Vx", -1.0, false},
               {"p", 1e-3, true},
               {"p", 1e3, true},
               {"alpha", 57.3, false},
               {"gamma", 573.0, false},
               {"Vx", 100.0, false},
               {"tread_center", 0.1, true},
               {"loaded_radius", 100, true},
               {"loaded_radius", -1, true},
               {"Fz", 1e-3, false},
               {"Fy", 1e4, true}};
  for (const auto& one : cases) {
    const auto doubts = doubts_about(times(one.channel, one.factor));
    ASSERT_FALSE(doubts.empty()) << one.channel << " times " << one.factor;
    bool is_error = false, is_named = false;
    for (const ChannelDoubt& doubt : doubts) {
      is_error = is_error || doubt.is_error;
      is_named = is_named || doubt.channel == one.channel ||
                 doubt.sentence.find(one.channel) != std::string::npos;
    }
    EXPECT_TRUE(is_named) << one.channel << " times " << one.factor << ": " << doubts[0].sentence;
    EXPECT_TRUE(is_error || !one.is_error) << one.channel << " times " << one.factor;
  }
}

/// A cornering test over five loads in which the stiffness by load falls with the load, as it does
/// on a tire, and the side force saturates; the inclination has the given sign.
Channels several_loads(double sign) {
  Channels channels;
  Channel alpha{"alpha", "rad", {}}, gamma{"gamma", "rad", {}}, Fz{"Fz", "N", {}},
      Fy{"Fy", "N", {}};
  for (const double load : {500.0, 1100.0, 1600.0, 2200.0, 2700.0})
    for (const double camber : {0.0, 2.0, 3.0})
      for (int i = -5; i <= 5; ++i) {
        const double a = 0.4 * i * kDegreeOfChecks, g = camber * kDegreeOfChecks;
        alpha.values.push_back(a);
        gamma.values.push_back(sign * g);
        Fz.values.push_back(load);
        Fy.values.push_back(-load * (std::tanh(35.0 * (1.0 - load / 5400.0) * a) + 1.3 * g));
      }
  for (Channel* one : {&alpha, &gamma, &Fz, &Fy}) channels.add(std::move(*one));
  return channels;
}

// The loads spread Fy / Fz by far more than the inclination does.
TEST(ChannelChecks, KnowTheSignOfTheInclinationOverSeveralLoads) {
  EXPECT_TRUE(doubts_about(several_loads(1.0)).empty());
  const auto doubts = doubts_about(several_loads(-1.0));
  ASSERT_EQ(doubts.size(), 1u);
  EXPECT_EQ(doubts[0].channel, "gamma");
  EXPECT_NE(doubts[0].sentence.find("grows by 0.0227 a degree"), std::string::npos)
      << doubts[0].sentence;  // 1.3 / rad
}

TEST(ChannelChecks, KeepARimInsideOfItsTire) {
  Channels header;
  header.add({"RIMDIAME", "m", {0.4572}});
  header.add({"OVALLDIA", "m", {0.4064}});
  const auto doubts = doubts_about(header);
  ASSERT_EQ(doubts.size(), 1u);
  EXPECT_TRUE(doubts[0].is_error);
}

TEST(ChannelChecks, NoticeAClockThatGoesBackward) {
  Channels back, runs;
  back.add({"time", "s", {0, -0.1, -0.2, -0.3}});
  ASSERT_EQ(doubts_about(back).size(), 1u);
  EXPECT_EQ(doubts_about(back)[0].channel, "time");
  runs.add({"time", "s", {0, 0.1, 0.2, 0, 0.1, 0.2}});  // the file contains two runs
  EXPECT_TRUE(doubts_about(runs).empty());
}

// Test the table of a K&C rig: a compliant part moves in the direction of the force.
TEST(ChannelChecks, KnowTheSignOfACompliance) {
  Channels table;
  table.add({"Fy", "N", {-1000, 0, 1000}});
  table.add({"dy", "m", {-1e-3, 0, 1e-3}});
  EXPECT_TRUE(doubts_about(table).empty());
  Channels turned;
  turned.add({"Fy", "N", {-1000, 0, 1000}});
  turned.add({"dy", "m", {1e-3, 0, -1e-3}});
  EXPECT_EQ(doubts_about(turned).size(), 1u);
}

TEST(ChannelChecks, CountGapsAndTellANegativeLoad) {
  Channels table;
  table.add({"load", "N", {-3000.0, -5000.0, -6000.0}});
  table.add({"length", "m", {0.1, std::nan(""), 0.14}});
  table.add({"never", "m", {std::nan(""), std::nan(""), std::nan("")}});
  const auto doubts = doubts_about(table);
  const auto gaps = gaps_in(table);
  ASSERT_EQ(doubts.size(), 1u);
  EXPECT_EQ(doubts[0].channel, "load");
  ASSERT_EQ(gaps.size(), 1u);
  EXPECT_EQ(gaps[0].channel, "length");
  EXPECT_NE(gaps[0].sentence.find("empty in 1 of 3 samples, first in sample 2"), std::string::npos);
}

/// Returns a motion and a force that vary along each of the axes: 4 kN cause the displacement
/// `most`.
Channels moved_wheel(const char* motion, const char* force, double most) {
  Channel d{motion, "m", {}}, F{force, "N", {}};
  for (int i = -4; i <= 4; ++i) {
    d.values.push_back(most * i / 4.0);
    F.values.push_back(1e3 * i);
  }
  Channels channels;
  channels.add(std::move(d));
  channels.add(std::move(F));
  return channels;
}

// The displacements 0.02 mm, 0.11 mm and 3 mm are in a column with the unit m; the first two
// numbers are still below 0.1 m.
TEST(ChannelChecks, ADisplacementInMillimetersReadAsMetersIsDoubted) {
  for (const auto& [motion, force] :
       {std::pair{"dx", "Fx"}, {"dy", "Fy"}, {"dy_L", "Fy_L"}, {"dz", "Fz"}, {"travel", "Fz"}}) {
    // displacement in mm under a load of 4 kN
    const double most = motion[1] == 'z' || motion[0] == 't' ? 30.0 : 0.05;
    EXPECT_FALSE(doubts_about(moved_wheel(motion, force, most)).empty()) << motion;
    EXPECT_TRUE(doubts_about(moved_wheel(motion, force, 1e-3 * most)).empty()) << motion;
  }
  const auto doubts = doubts_about(moved_wheel("dy", "Fy", 0.05));
  ASSERT_EQ(doubts.size(), 1u);
  EXPECT_NE(doubts[0].sentence.find("80 N/mm"), std::string::npos) << doubts[0].sentence;
}

TEST(ChannelChecks, ADisplacementInMetersReadAsMillimetersIsDoubted) {
  EXPECT_FALSE(doubts_about(moved_wheel("dy", "Fy", 5e-8)).empty());
  EXPECT_TRUE(doubts_about(moved_wheel("dy", "Fy", 5e-5)).empty());
}

}  // namespace
}  // namespace latsch
