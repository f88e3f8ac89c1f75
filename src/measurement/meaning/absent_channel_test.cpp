// SPDX-License-Identifier: Apache-2.0
#include "measurement/meaning/absent_channel.h"

#include <gtest/gtest.h>

namespace latsch {
namespace {

OtherColumn column(const std::string& name, const std::string& unit) {
  return {name, unit, !unit.empty()};
}

std::string offered(const std::string& channel,
                    const std::string& unit,
                    const std::vector<OtherColumn>& columns) {
  std::string names;
  for (const MayBe& one : columns_that_may_be(channel, unit, columns))
    names += (names.empty() ? "" : ", ") + one.column;
  return names;
}

TEST(AbsentChannel, AnAngleOfAnotherMeaningMayBeTheSlipAngle) {
  for (const char* name :
       {"Toe", "steer", "Lenkwinkel", "Steering angle", "yaw", "Kanal 7", "SA_FL", "|SA|", "-SA"})
    EXPECT_EQ(offered("alpha", "rad", {column("Fz", "N"), column(name, "rad")}), name);
  EXPECT_EQ(offered("alpha", "rad", {column("camber", "rad"), column("yaw", "N")}), "");
  EXPECT_EQ(offered("alpha", "rad", {{"SA", "rad", true, "gamma", true}}), "SA");
  // the loads Fx_L belong to an axle, which has its loads already
  EXPECT_EQ(offered("Fx", "N", {{"Fx_L", "N", true, "Fx_L", true}}), "");
  EXPECT_EQ(offered("alpha", "rad", {{"SA", "rad", true, "alpha", true}}), "");
  EXPECT_EQ(offered("alpha", "rad", {{"yaw", "rad", true, "gamma", true}}), "");
  EXPECT_EQ(offered("alpha", "rad", {{"yaw", "rad", true, "yaw", false}}), "yaw");
}

TEST(AbsentChannel, SlipsMayBeComputed) {
  const std::vector<OtherColumn> all = {column("omega", "rad/s"), column("V", "m/s")};
  EXPECT_EQ(offered("kappa", "1", all), "omega");
  EXPECT_FALSE(columns_that_may_be("kappa", "1", all).front().is_as_it_stands);
  EXPECT_EQ(offered("kappa", "1", {column("omega", "rad/s")}), "");
  EXPECT_EQ(
      offered("kappa", "1", {column("omega", "rad/s"), column("Vx", "m/s"), column("SL", "1")}),
      "omega, SL");
  EXPECT_EQ(offered("alpha", "rad", {column("Vy", "m/s"), column("Vx", "m/s")}), "Vy");
  EXPECT_EQ(offered("kappa", "1", {column("NFX", "1"), column("NFY", "1")}), "");
  for (const char* ratio : {"Vy/Vx", "VY / VX", "Vy over Vx"}) {
    EXPECT_EQ(offered("alpha", "rad", {column(ratio, "1")}), ratio);
    EXPECT_FALSE(columns_that_may_be("alpha", "rad", {column(ratio, "1")}).front().is_as_it_stands);
    EXPECT_EQ(offered("kappa", "1", {column(ratio, "1")}), "");
  }
}

// The column "tan alpha" has the dimension of a slip, but its name already says to which channel it
// belongs.
TEST(AbsentChannel, ANameThatContainsAChannelIsOfferedForThatOneOnly) {
  const std::vector<OtherColumn> tangent = {column("tan alpha", "1")};
  EXPECT_EQ(offered("kappa", "1", tangent), "");
  EXPECT_EQ(offered("alpha", "rad", tangent), "tan alpha");
  EXPECT_FALSE(columns_that_may_be("alpha", "rad", tangent).front().is_as_it_stands);
  EXPECT_FALSE(
      columns_that_may_be("alpha", "rad", {column("tan(alpha)", "")}).front().is_as_it_stands);
  EXPECT_EQ(offered("gamma", "rad", {column("mean slip angle", "rad")}), "");
  EXPECT_EQ(offered("gamma", "rad", {column("WheelSlipAngle", "rad")}), "");
  EXPECT_EQ(offered("alpha", "rad", {column("AlphaDeg", "")}), "AlphaDeg");
  EXPECT_EQ(offered("kappa", "1", {column("AlphaDeg", "")}), "");
  EXPECT_EQ(offered("kappa", "1", {column("sqrt(FZ)", "")}), "");
  for (const char* name : {"TANALPHA", "sinSA", "tan_slipangle"}) {  // TANALPHA is of TYDEX
    EXPECT_EQ(offered("kappa", "1", {column(name, "1")}), "") << name;
    EXPECT_EQ(offered("alpha", "rad", {column(name, "1")}), name);
    EXPECT_FALSE(columns_that_may_be("alpha", "rad", {column(name, "1")}).front().is_as_it_stands);
  }
}

// A column of one letter with another unit is another quantity, such as a voltage, or a mistake.
TEST(AbsentChannel, AKnownNameWithAUnitOfAnotherDimensionIsOffered) {
  for (const char* unit : {"rad/s", "N", "rad", "1/s", "m/s2"}) {
    EXPECT_EQ(offered("Vx", "m/s", {column("V", unit)}), "V") << unit;
    EXPECT_FALSE(columns_that_may_be("Vx", "m/s", {column("V", unit)}).front().is_as_it_stands);
  }
  EXPECT_EQ(offered("p", "Pa", {column("P", "N")}), "P");
  EXPECT_EQ(offered("omega", "rad/s", {column("N", "m")}), "N");
  EXPECT_EQ(offered("p", "Pa", {column("V", "N")}), "");
}

TEST(AbsentChannel, AListSaysHowManyItDoesNotName) {
  std::vector<MayBe> many;
  for (int i = 0; i < 9; ++i) many.push_back({"c" + std::to_string(i), ""});
  many.front().words = "an angle";
  EXPECT_EQ(list_in_words(many, 2), "`c0` (an angle), `c1` and 7 more");
}

// The column is tan alpha or Vy / Vx, with an unknown name. Numbers of only one sign, or above 1.5,
// are not offered.
TEST(AbsentChannel, APlainNumberLikeASlipMayBeTheTangentOfTheSlipAngle) {
  OtherColumn plain = column("sigma_y", "1");
  plain.is_slip_like = true;
  EXPECT_EQ(offered("alpha", "rad", {plain}), "sigma_y");
  EXPECT_FALSE(columns_that_may_be("alpha", "rad", {plain}).front().is_as_it_stands);
  EXPECT_EQ(offered("gamma", "rad", {plain}), "");
  plain.is_slip_like = false;
  EXPECT_EQ(offered("alpha", "rad", {plain}), "");
}

TEST(AbsentChannel, AColumnThatContainsTheNameComesFirst) {
  EXPECT_EQ(columns_that_may_be("toe", "rad", {column("spin", "rad"), column("toe_left", "rad")})
                .front()
                .column,
            "toe_left");
}

}  // namespace
}  // namespace latsch
