// SPDX-License-Identifier: Apache-2.0
#include "measurement/meaning/channel_words.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace latsch {
namespace {

TEST(ChannelWords, OneChannelHasManySpellings) {
  const std::map<std::string, std::vector<std::string>> spellings = {
      {"alpha",
       {"alpha",
        "Alpha",
        "ALPHA",
        "SA",
        "sa",
        "SLIPANGL",
        "SlipAngle",
        "slip angle",
        "slip_angle",
        "Slip-Angle",
        "Schräglaufwinkel",
        "SCHRÄGLAUFWINKEL",
        "Schraeglaufwinkel",
        "α"}},
      {"gamma", {"gamma", "IA", "INCLANGL", "Inclination Angle", "Sturz", "camber"}},
      {"kappa", {"kappa", "SR", "LONGSLIP", "Slip Ratio", "Längsschlupf"}},
      {"Fz", {"Fz", "FZ", "fz", "Normal load", "Radlast", "vertical_load", "load"}},
      {"FzW", {"FZW", "FzW", "fzw"}},
      {"Fy", {"Fy", "FY", "Lateral force", "Seitenkraft", "side_force"}},
      {"Mz", {"MZ", "Aligning Torque", "aligning_moment", "Rückstellmoment"}},
      {"p", {"p", "P", "INFLPRES", "Inflation Pressure", "Reifendruck", "pressure"}},
      {"Vx", {"V", "v", "LONGVEL", "speed", "Geschwindigkeit"}},
      {"time", {"ET", "RUNTIME", "Zeit", "Time"}},
      {"loaded_radius", {"RL", "R_l", "DSTGRWHC", "Loaded Radius"}},
      {"Fz_FL", {"Fz_FL", "FZ_fl", "FZ FL"}}};
  for (const auto& [channel, names] : spellings)
    for (const std::string& name : names) {
      const auto found = recognized(name);
      ASSERT_TRUE(found) << name;
      EXPECT_EQ(found->channel, channel) << name;
      EXPECT_EQ(found->unit, "") << name;
    }
}

TEST(ChannelWords, ANameMayEndInItsUnit) {
  const std::vector<std::array<std::string, 3>> names = {{"Alpha (deg)", "alpha", "deg"},
                                                         {"SA [deg]", "alpha", "deg"},
                                                         {"Fz[N]", "Fz", "N"},
                                                         {"FZ_N", "Fz", "N"},
                                                         {"SA_deg", "alpha", "deg"},
                                                         {"p_kPa", "p", "kPa"},
                                                         {"P_KPA", "p", "kPa"},
                                                         {"V_kmh", "Vx", "km/h"}};
  for (const auto& [written, channel, unit] : names) {
    const auto found = recognized(written);
    ASSERT_TRUE(found) << written;
    EXPECT_EQ(found->channel, channel) << written;
    EXPECT_EQ(found->unit, unit) << written;
  }
}

TEST(ChannelWords, OthersAreNotTaken) {
  for (const char* name :
       {"TSTX", "FREQ", "who", "drum_speed", "dz_by_Fz", "Fz_kPa", "slip", "moment", "force", ""})
    EXPECT_FALSE(recognized(name)) << name;
}

TEST(ChannelWords, AnOperatorMakesAnotherQuantity) {
  for (const char* name :
       {"-SA", "|SA|", "ΔSA", "σ FY", "SA*2", "1/SR", "Fy/Fz", "SA²", "FZ'", "±SA", "−SA"})
    EXPECT_FALSE(recognized(name)) << name;
  for (const char* name : {"F_{z}", "F\u00a0z", "Schra\u0308glaufwinkel", "slip\u2010angle", "SA."})
    EXPECT_TRUE(recognized(name)) << name;
}

TEST(ChannelWords, AWordOfTwoMeaningsKeepsItsName) {
  for (const char* name : {"camber", "pressure", "speed", "load", "wheel_speed"}) {
    ASSERT_TRUE(recognized(name));
    EXPECT_TRUE(recognized(name)->keeps_name) << name;
  }
  for (const char* name : {"IA", "SA", "Radlast", "Fz", "alpha"})
    EXPECT_FALSE(recognized(name)->keeps_name) << name;
  EXPECT_TRUE(same_channel("camber", "IA"));
  EXPECT_FALSE(same_channel("FyW", "Fy"));
  EXPECT_FALSE(same_channel("FyW", "FyH"));
}

TEST(ChannelWords, ATypoLooksLikeItsChannel) {
  const std::vector<std::string> names = {"Alhpa", "alpha_corrected", "SR", "TSTC", "slip anlge"};
  const auto alike = look_like("alpha", names);
  EXPECT_NE(std::find(alike.begin(), alike.end(), "Alhpa"), alike.end());
  EXPECT_NE(std::find(alike.begin(), alike.end(), "alpha_corrected"), alike.end());
  EXPECT_NE(std::find(alike.begin(), alike.end(), "slip anlge"), alike.end());
  EXPECT_EQ(alike.size(), 3u);
  EXPECT_TRUE(look_like("kappa", {"Fz", "TSTC", "RST2"}).empty());
}

}  // namespace
}  // namespace latsch
