// SPDX-License-Identifier: Apache-2.0
#include "evaluation/outside_program/input_template.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace latsch {
namespace {

DesignSpace template_space() {
  return DesignSpace(
      {{.name = "modulus", .lower = 1e9, .upper = 1e12, .initial = 2.1e11, .unit = "N/mm^2"},
       {.name = "ratio", .lower = 0.0, .upper = 0.5, .initial = 0.3}});
}

std::string filled(const std::string& text, double modulus = 2.1e11, double ratio = 0.3) {
  return InputTemplate(text, "deck.inp", template_space())
      .filled(template_space(), {{modulus, ratio}});
}

std::string complaint(const std::string& text) {
  try {
    InputTemplate(text, "deck.inp", template_space());
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(InputTemplate, HolesAreFilledInTheUnitOfTheirVariable) {
  EXPECT_EQ(filled("*ELASTIC\n{modulus}, {ratio}\n"), "*ELASTIC\n210000, 0.3\n");
  EXPECT_EQ(filled("{modulus:%.3e}|{ratio:%8.4f}"), "2.100e+05|  0.3000");
}

TEST(InputTemplate, WithoutAFormatNoBitIsLost) {
  for (const double value : {1.0 / 3.0, 0.1, 2.0 / 7.0, 0.49999999999999994}) {
    EXPECT_EQ(std::stod(filled("{ratio}", 2.1e11, value)), value);
  }
}

TEST(InputTemplate, OtherBracesAreLeftAloneAndDoubledOnesAreOne) {
  EXPECT_EQ(filled(R"({"a": {ratio}, "b": {1}, "c": {}})"), R"({"a": 0.3, "b": {1}, "c": {}})");
  EXPECT_EQ(filled("{{ratio}} {"), "{ratio} {");
}

TEST(InputTemplate, AHoleForNothingIsRefusedWithItsLine) {
  const std::string unknown = complaint("a\nb {modulos} c\n");
  EXPECT_NE(unknown.find("deck.inp:2"), std::string::npos) << unknown;
  EXPECT_NE(unknown.find("did you mean \"modulus\""), std::string::npos) << unknown;
  for (const char* format : {"%s", "%n", "%d", "%*g", "%.6g%g", "%1000000000g"}) {
    EXPECT_NE(complaint("{modulus:" + std::string(format) + "}"), "") << format;
  }
}

TEST(InputTemplate, KnowsWhichVariablesItUses) {
  const InputTemplate text("{ratio}", "deck.inp", template_space());
  EXPECT_FALSE(text.uses(0));
  EXPECT_TRUE(text.uses(1));
}

}  // namespace
}  // namespace latsch
