// SPDX-License-Identifier: Apache-2.0
#include "correlation/study/linear_constraints.h"

#include <gtest/gtest.h>

#include <cmath>

namespace latsch::correlation {
namespace {

const std::vector<DesignVariable> kVariables{
    {.name = "belt", .lower = 1e9, .upper = 9e9, .initial = 2e9, .unit = "GPa"},
    {.name = "angle", .lower = 0.1, .upper = 0.9, .initial = 0.4, .unit = "deg"},
    {.name = "cap", .lower = 1e9, .upper = 9e9, .initial = 3e9, .unit = "N/mm^2"}};

LinearConstraint constraint_of(const std::string& text, const std::string& head = "[c.row]") {
  const Document document = Document::parse(head + "\n" + text, "study.toml");
  const Node root = document.root();
  const auto constraint = read_linear_constraint(root.named_tables("c").front(), kVariables);
  root.close();
  return constraint;
}

std::string constraint_complaint(const std::string& text) {
  try {
    constraint_of(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

#define EXPECT_SAYS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

TEST(StudyLinearConstraint, IsReadInSiAndSaidInTheUnitsOfThePerson) {
  const DesignSpace space(kVariables);
  const LinearConstraint row = constraint_of(
      "variables = [\"cap\", \"belt\"]\ncoefficients = [1, -2]\nupper = \"500 N/mm^2\"");
  EXPECT_EQ(row.coefficients, (std::vector<double>{-2, 0, 1}));
  EXPECT_DOUBLE_EQ(row.upper, 5e8);
  EXPECT_TRUE(std::isinf(row.lower));
  EXPECT_EQ(in_words(row, space), "-2 belt + cap <= 500 N/mm^2");
  EXPECT_EQ(in_words(constraint_of("variables = [\"belt\", \"cap\"]\nequal = \"5 GPa\""), space),
            "belt + cap = 5 GPa");
  EXPECT_EQ(in_words(constraint_of("variables = [\"belt\"]\nlower = \"2 GPa\"\nupper = \"3 GPa\""),
                     space),
            "2 GPa <= belt <= 3 GPa");
}

TEST(StudyLinearConstraint, HasToHaveAName) {
  try {
    constraint_of("variables = [\"belt\"]\nupper = \"2 GPa\"", "[[c]]");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_SAYS(std::string(error.what()), "study.toml:1");
    EXPECT_SAYS(std::string(error.what()), "[linear_constraint.belt_sum]");
  }
}

TEST(StudyLinearConstraint, SaysWhatIsWrong) {
  EXPECT_SAYS(constraint_complaint("variables = [\"bolt\"]\nupper = \"2 GPa\""), "study.toml:2");
  EXPECT_SAYS(constraint_complaint("variables = [\"bolt\"]\nupper = \"2 GPa\""),
              "did you mean \"belt\"?");
  EXPECT_SAYS(constraint_complaint("variables = [\"belt\", \"angle\"]\nupper = \"2 GPa\""),
              "adds angle in deg to belt in GPa");
  EXPECT_SAYS(
      constraint_complaint("variables = [\"belt\"]\ncoefficients = [1, 2]\nupper = \"2 GPa\""),
      "are 2 for 1 variables");
  EXPECT_SAYS(constraint_complaint("variables = [\"belt\"]\nequal = \"2 GPa\"\nupper = \"2 GPa\""),
              "is given beside lower or upper");
  EXPECT_SAYS(constraint_complaint("variables = [\"belt\"]\nupper = \"2 mm\""), "study.toml:3");
  EXPECT_SAYS(constraint_complaint("variables = [\"belt\"]\nuper = \"2 mm\""),
              "did you mean \"upper\"");
  EXPECT_SAYS(constraint_complaint("variables = []\nupper = \"2 GPa\""), "is empty");
}

}  // namespace
}  // namespace latsch::correlation
