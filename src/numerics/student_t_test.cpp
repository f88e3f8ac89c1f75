// SPDX-License-Identifier: Apache-2.0
#include "numerics/student_t.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace latsch::numerics {
namespace {

TEST(StudentT, OneAndTwoDegreesOfFreedomAreKnownInClosedForm) {
  for (double p : {0.6, 0.9, 0.975, 0.999, 0.1}) {
    const double one = std::tan(std::numbers::pi * (p - 0.5));
    const double two = (2.0 * p - 1.0) / std::sqrt(2.0 * p * (1.0 - p));
    EXPECT_NEAR(student_t_quantile(p, 1), one, 1e-11 * std::abs(one));
    EXPECT_NEAR(student_t_quantile(p, 2), two, 1e-11 * std::abs(two));
  }
}

// The values are from Abramowitz and Stegun, table 26.10, two-sided 95 %: A = 0.95.
TEST(StudentT, AgreesWithThePrintedTable) {
  const struct {
    double nu, t;
  } rows[] = {{3, 3.182}, {5, 2.571}, {10, 2.228}, {30, 2.042}, {120, 1.980}};
  for (const auto& row : rows) EXPECT_NEAR(student_t_quantile(0.975, row.nu), row.t, 0.0005);
}

TEST(StudentT, BecomesTheNormalDistribution) {
  EXPECT_NEAR(student_t_quantile(0.975, std::numeric_limits<double>::infinity()), 1.959964, 1e-6);
  // t = z + (z^3 + z) / (4 nu) + ... [Abramowitz, Stegun, 26.7.5]
  constexpr double z = 1.959963984540054;
  for (const double nu : {1e6, 1e7, 1e9, 1e13, 1e22, 1e100, 1e300})
    EXPECT_NEAR(student_t_quantile(0.975, nu), z + (z * z * z + z) / (4.0 * nu), 1e-10) << nu;
}

}  // namespace
}  // namespace latsch::numerics
