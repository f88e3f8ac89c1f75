// SPDX-License-Identifier: Apache-2.0
#include "correlation/study/settings/rig_limit.h"

#include <gtest/gtest.h>

#include <cmath>

namespace latsch::correlation {
namespace {

constexpr double kDegree = 0.017453292519943295;

const std::vector<std::string>& rig_names() {
  static const std::vector<std::string> names{"load", "alpha", "speed"};
  return names;
}

/// A load and a slip angle that move, and a speed of 20 m/s that stays.
std::optional<LimitedNumber> rig_number(const std::string& name) {
  if (name == "load") return LimitedNumber{0, 0.0, Unit::of("N").dimension()};
  if (name == "alpha") return LimitedNumber{1, 0.0, Unit::of("rad").dimension()};
  if (name == "speed") return LimitedNumber{-1, 20.0, Unit::of("m/s").dimension()};
  return std::nullopt;
}

bool holds(const std::string& text, double load, double alpha) {
  const auto limit = RigLimit::read(text, rig_number, rig_names());
  EXPECT_TRUE(limit) << text << ": " << (limit ? "" : limit.failure().reason);
  return limit && limit->holds({load, alpha});
}

std::string fault(const std::string& text) {
  const auto limit = RigLimit::read(text, rig_number, rig_names());
  return limit ? "" : limit.failure().reason;
}

TEST(RigLimit, AProductOfLoadAndSlipAngleIsLimitedOnBothSides) {
  const std::string text = "load * abs(alpha) <= 40 kN deg";
  EXPECT_TRUE(holds(text, 4000.0, 10.0 * kDegree));
  EXPECT_TRUE(holds(text, 4000.0, -10.0 * kDegree));
  EXPECT_FALSE(holds(text, 4000.0, 10.01 * kDegree));
  EXPECT_FALSE(holds(text, 8000.0, -5.01 * kDegree));
}

TEST(RigLimit, OperatorsBindAsInArithmetic) {
  EXPECT_TRUE(holds("load >= 1 kN + 2 * 500 N", 2000.0, 0.0));
  EXPECT_FALSE(holds("load >= 1 kN + 2 * 500 N", 1999.0, 0.0));
  EXPECT_TRUE(holds("load - 1 kN - 500 N <= 500 N", 2000.0, 0.0));
  EXPECT_TRUE(holds("load / 2 / 2 <= 500 N", 2000.0, 0.0));
  EXPECT_TRUE(holds("(load / 1 kN)^2 <= 4", 2000.0, 0.0));
  EXPECT_FALSE(holds("(load / 1 kN)^2 < 4", 2000.0, 0.0));
  EXPECT_TRUE(holds("-load < 0", 1.0, 0.0));
  EXPECT_TRUE(holds("sqrt(load * load) >= 1 kN", 1000.0, 0.0));
}

TEST(RigLimit, PowerOfTheRigIsLoadTimesTangentTimesSpeed) {
  const std::string text = "load * tan(alpha) * speed <= 10 kW";
  EXPECT_TRUE(holds(text, 4000.0, std::atan(0.124)));
  EXPECT_FALSE(holds(text, 4000.0, std::atan(0.126)));
  EXPECT_TRUE(holds("max(load, 2 kN) / min(speed, 10 m/s) <= 200 N s/m", 1000.0, 0.0));
}

TEST(RigLimit, AZeroHasEveryDimension) {
  EXPECT_TRUE(holds("alpha >= 0", 0.0, 0.1));
  EXPECT_FALSE(holds("alpha >= 0", 0.0, -0.1));
}

TEST(RigLimit, SaysWhatIsWrong) {
  EXPECT_NE(fault("loda <= 8 kN").find("did you mean \"load\"?"), std::string::npos);
  EXPECT_EQ(fault("load <= 8 deg"), "compares N with rad");
  EXPECT_EQ(fault("load + alpha <= 8 kN"), "adds N and rad");
  EXPECT_NE(fault("load <= 8 kNx").find("unknown unit"), std::string::npos);
  EXPECT_NE(fault("load").find("has no <="), std::string::npos);
  EXPECT_NE(fault("load <= 8 kN <= 9 kN").find("second limit"), std::string::npos);
  EXPECT_NE(fault("abs(load <= 8 kN").find("lacks a )"), std::string::npos);
  EXPECT_NE(fault("tan(load) <= 1").find("expected an angle"), std::string::npos);
  EXPECT_NE(fault("log(load) <= 1").find("expected abs"), std::string::npos);
  EXPECT_NE(fault("load <= ").find("ends where"), std::string::npos);
  EXPECT_NE(fault("").find("ends where"), std::string::npos);
  EXPECT_NE(fault("sqrt(load) <= 1").find("sqrt of N"), std::string::npos);
  EXPECT_NE(fault("load = 8 kN").find("where an operator"), std::string::npos);
}

TEST(RigLimit, ALoadOnItsLimitIsInsideDespiteRounding) {
  // 0.1 + 0.2 is larger than 0.3 by rounding
  EXPECT_TRUE(holds("load + 0.1 N <= 0.3 N", 0.2, 0.0));
}

}  // namespace
}  // namespace latsch::correlation
