// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/slip/condition_levels.h"

#include <gmock/gmock.h>

#include <map>
#include <numbers>

#include "models/magic_formula/parameters.h"

namespace latsch {
namespace {

using magic_formula::reason_against;
using testing::HasSubstr;

constexpr double kDegree = std::numbers::pi / 180.0;

magic_formula::ConditionLevels of(const std::map<std::string, std::vector<double>>& states) {
  return condition_levels([&](const std::string& channel) {
    const auto found = states.find(channel);
    return found == states.end() ? std::vector<double>{} : found->second;
  });
}

TEST(ConditionLevels, TwoPressuresTellNoQuadraticTermAndThreeDo) {
  const auto two = of({{"p", {69e3, 83e3, 69.5e3, 83.4e3}}, {"Fz", {600, 1100, 1600}}});
  EXPECT_EQ(reason_against("PPY1", two), "");
  EXPECT_EQ(reason_against("PPY2", two), "");
  for (const char* quadratic : {"PPY4", "PPX2", "PPX4"})
    EXPECT_EQ(reason_against(quadratic, two),
              "of order 2 in the pressure, of which there are 2 levels: 69.5, 83.4 kPa")
        << quadratic;
  EXPECT_EQ(reason_against("PPY4", of({{"p", {69e3, 83e3, 97e3}}})), "");
}

TEST(ConditionLevels, EveryConditionCountsThatATermStandsBefore) {
  const auto one_load =
      of({{"Fz", {1600, 1620}}, {"gamma", {0.0, 2 * kDegree}}, {"p", {8e4, 9e4}}});
  EXPECT_THAT(reason_against("PDY2", one_load),
              HasSubstr("order 1 in the load, of which there is 1"));
  EXPECT_THAT(reason_against("PPY2", one_load), HasSubstr("in the load"));  // pressure and load
  EXPECT_THAT(reason_against("PKY7", one_load), HasSubstr("in the load"));  // camber and load
  EXPECT_EQ(reason_against("PKY6", one_load), "");
  const auto two_loads = of({{"Fz", {800, 1600}}});
  EXPECT_THAT(reason_against("QBZ3", two_loads), HasSubstr("order 2 in the load"));
  EXPECT_THAT(reason_against("PKX3", two_loads), HasSubstr("order 2 in the load"));
  EXPECT_EQ(reason_against("QBZ2", two_loads), "");
  EXPECT_THAT(reason_against("QSY3", two_loads),
              HasSubstr("in the speed, of which there is no record"));
  EXPECT_THAT(reason_against("QSY4", of({{"Vx", {10, 20, 30, 40}}})), HasSubstr("order 4"));
}

TEST(ConditionLevels, EvenTermsAskForSizesAndModuliForSigns) {
  const auto both = of({{"gamma", {-2 * kDegree, 2 * kDegree}}});
  EXPECT_THAT(reason_against("PDY3", both), HasSubstr("even function of the camber"));
  EXPECT_EQ(reason_against("PKY6", both), "");
  EXPECT_EQ(reason_against("QBZ5", both), "");
  const auto one_side = of({{"gamma", {0.0, 2 * kDegree}}});
  EXPECT_EQ(reason_against("PDY3", one_side), "");
  EXPECT_THAT(reason_against("QBZ5", one_side), HasSubstr("one sign"));
  EXPECT_THAT(reason_against("QDZ4", one_side), HasSubstr("order 2 in the camber"));
}

// If a coefficient's name belonged to no parameter, the coefficient would never be reported.
TEST(ConditionLevels, EveryCoefficientOfAConditionIsAParameter) {
  int of_a_condition = 0;
  for (const auto& field : magic_formula::parameter_fields())
    of_a_condition += magic_formula::conditions_of(field.name).empty() ? 0 : 1;
  EXPECT_GE(of_a_condition, 70);
  EXPECT_TRUE(magic_formula::conditions_of("PCY1").empty());
}

}  // namespace
}  // namespace latsch
