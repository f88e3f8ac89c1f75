// SPDX-License-Identifier: Apache-2.0
#include "nist_strd/nist_strd.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace latsch::nist_strd {
namespace {

double sum_of_squares(const Dataset& data, const std::vector<double>& b) {
  double sum = 0.0;
  for (const double r : residuals(data, b)) sum += r * r;
  return sum;
}

TEST(NistStrd, SumsOfSquaresAtTheCertifiedValuesAreTheCertifiedOnes) {
  ASSERT_EQ(names().size(), 27u);
  for (const std::string& name : names()) {
    const Dataset data = read_dataset(name);
    // Eleven digits of b: where the data are exact to more, as those of Lanczos, rounding is all
    // that is left of the sum.
    const double rounding = 1e-20 * static_cast<double>(data.rows.size());
    EXPECT_NEAR(sum_of_squares(data, data.certified), data.sum, 1e-8 * data.sum + rounding) << name;
    EXPECT_EQ(data.start_1.size(), data.certified.size()) << name;
    EXPECT_EQ(data.start_2.size(), data.certified.size()) << name;
  }
}

TEST(NistStrd, NoStartIsSolved) {
  EXPECT_EQ(problems().size(), 52u);
  for (const more_wild::Problem& problem : problems()) {
    EXPECT_GT(problem.value(problem.start), problem.least) << problem.name;
  }
}

TEST(NistStrd, ATableThatIsNotThereIsNamed) {
  EXPECT_THROW(read_dataset("Misra2"), InputError);
  EXPECT_THROW(residuals({.name = "Misra2"}, {}), std::out_of_range);
}

}  // namespace
}  // namespace latsch::nist_strd
