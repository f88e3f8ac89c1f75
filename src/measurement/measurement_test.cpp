// SPDX-License-Identifier: Apache-2.0
// Every kind of bad measurement is found, at its point.
#include <gtest/gtest.h>

#include <limits>

#include "measurement/load_deflection.h"
#include "measurement/mode_table.h"

namespace latsch {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

LoadDeflectionCurve curve() {
  return {Abscissa::deflection, {0.005, 0.01, 0.02}, {800, 1700, 3600}, {10, 12, 20}};
}

TEST(LoadDeflectionFault, GoodCurvesHaveNone) {
  EXPECT_FALSE(find_fault(curve()));
  EXPECT_FALSE(find_fault({Abscissa::loaded_radius, {0.2, 0.19}, {500, 1500}, {}}));
  EXPECT_FALSE(find_fault({Abscissa::deflection, {0.02}, {3600}, {}}));
}

TEST(LoadDeflectionFault, IsFoundAtItsPoint) {
  const auto fault = [](auto change) {
    LoadDeflectionCurve bad = curve();
    change(bad);
    const auto found = find_fault(bad);
    return found ? std::to_string(found->point) + ": " + found->message : "";
  };
  EXPECT_EQ(fault([](auto& c) { c = {}; }), "-1: holds no point, expected at least one");
  EXPECT_EQ(fault([](auto& c) { c.force.pop_back(); }), "-1: has columns of unequal length");
  EXPECT_EQ(fault([](auto& c) { c.force[1] = kNan; }), "1: force is nan N, expected more than 0 N");
  EXPECT_EQ(fault([](auto& c) { c.force[0] = 0.0; }), "0: force is 0 N, expected more than 0 N");
  EXPECT_EQ(fault([](auto& c) { c.position[0] = -0.1; }),
            "0: deflection is -0.1 m, expected more than 0 m");
  EXPECT_EQ(fault([](auto& c) { c.spread[2] = -1.0; }), "2: spread is -1 N, expected at least 0 N");
  EXPECT_EQ(fault([](auto& c) { c.position[2] = 0.01; }),
            "2: deflection is 0.01 m after 0.01 m, expected values that all rise or all fall");
  EXPECT_EQ(fault([](auto& c) {
              c.abscissa = Abscissa::loaded_radius, c.position = {0.2, 0.19, 0.195};
            }),
            "2: loaded_radius is 0.195 m after 0.19 m, expected values that all rise or all fall");
}

TEST(ModeTableFault, IsFoundAtItsMode) {
  const ModeTable good{{{43.0, 1, "lateral", 's', {1, 0, 0}}, {51.0, {}, "", ' ', {0, 1, 0}}},
                       {{0.0, 0.1, 0.3}}};
  EXPECT_FALSE(find_fault(good));
  const auto fault = [&](auto change) {
    ModeTable bad = good;
    change(bad);
    const auto found = find_fault(bad);
    return found ? std::to_string(found->point) + ": " + found->message : "";
  };
  EXPECT_EQ(fault([](auto& t) { t.modes.clear(); }), "-1: holds no mode, expected at least one");
  EXPECT_EQ(fault([](auto& t) { t.modes[1].frequency = kNan; }),
            "1: frequency is nan Hz, expected more than 0 Hz");
  EXPECT_EQ(fault([](auto& t) { t.modes[0].n = -1; }),
            "0: n is -1, expected a number of waves, 0 or more");
  EXPECT_EQ(fault([](auto& t) { t.modes[0].phase = 'x'; }),
            "0: phase is \"x\", expected \"s\", \"a\" or nothing");
  EXPECT_EQ(fault([](auto& t) { t.modes[1].shape.clear(); }),
            "1: shape has 0 values, expected 3: x, y, z of every sensor point");
  EXPECT_EQ(fault([](auto& t) { t.modes[1].shape = {0, 0, 0}; }), "1: shape is zero everywhere");
  EXPECT_EQ(fault([](auto& t) { t.modes[1].shape[0] = kNan; }),
            "1: shape holds a number that is not finite");
  EXPECT_EQ(fault([](auto& t) { t.points[0][1] = kNan; }),
            "-1: has a sensor point that is not finite");
}

}  // namespace
}  // namespace latsch
