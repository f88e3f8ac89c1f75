// SPDX-License-Identifier: Apache-2.0
#include "optimization/problem/ending_claim.h"

#include <gtest/gtest.h>

namespace latsch {
namespace {

TEST(EndingClaim, OfWordsHasItsStatementBeforeTheColon) {
  const auto claims = claims_in("at a minimum: the next step is short: shorter than asked");
  ASSERT_EQ(claims.size(), 1u);
  EXPECT_EQ(claims[0].statement, "at a minimum");
  EXPECT_EQ(claims[0].test, "the next step is short: shorter than asked");
  EXPECT_EQ(claims_in("where no direction gains")[0].statement, "where no direction gains");
  EXPECT_TRUE(claims_in("").empty());
}

TEST(EndingClaim, ShowsItsNumbersWithUnitsAndLimits) {
  const EndingClaim claim{
      .statement = "at a bound",
      .variables = {"a", "b", "c"},
      .test = "",
      .numbers = {{.name = "rise", .value = 1.234e-3, .unit = "of S", .at_least = 0.0},
                  {.name = "trials", .value = 3.0}}};
  EXPECT_EQ(numbers_in_words(claim),
            "at a bound in \"a\", \"b\" and \"c\": rise 0.0012 of S (at least 0), trials 3");
  EXPECT_EQ(numbers_in_words({.statement = "at a minimum", .test = "slopes"}), "");
}

}  // namespace
}  // namespace latsch
