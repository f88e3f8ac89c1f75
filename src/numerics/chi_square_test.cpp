// SPDX-License-Identifier: Apache-2.0
#include "numerics/chi_square.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace latsch::numerics {
namespace {

// Closed forms for 1, 2 and 4 degrees of freedom: the square of a normal number, the exponential
// distribution, and 1 - (1 + x/2) exp(-x/2).
TEST(ChiSquare, FewDegreesOfFreedomAreKnownInClosedForm) {
  for (const double x : {0.01, 0.5, 1.9, 3.0, 8.0, 30.0}) {
    EXPECT_NEAR(chi_square_probability(x, 1), std::erf(std::sqrt(0.5 * x)), 1e-13) << x;
    EXPECT_NEAR(chi_square_probability(x, 2), 1.0 - std::exp(-0.5 * x), 1e-13) << x;
    EXPECT_NEAR(chi_square_probability(x, 4), 1.0 - (1.0 + 0.5 * x) * std::exp(-0.5 * x), 1e-13)
        << x;
  }
  for (const double p : {0.001, 0.05, 0.5, 0.95, 0.999})
    EXPECT_NEAR(chi_square_quantile(p, 2), -2.0 * std::log(1.0 - p), 1e-11);
}

// The values are from Abramowitz and Stegun, table 26.8: exceeded with probability 0.05 and 0.95.
TEST(ChiSquare, AgreesWithThePrintedTable) {
  const struct {
    double nu, upper, lower;
  } rows[] = {{3, 7.81473, 0.351846},
              {10, 18.3070, 3.94030},
              {30, 43.7729, 18.4926},
              {100, 124.342, 77.9295}};
  for (const auto& row : rows) {
    EXPECT_NEAR(chi_square_quantile(0.95, row.nu), row.upper, 6e-6 * row.upper) << row.nu;
    EXPECT_NEAR(chi_square_quantile(0.05, row.nu), row.lower, 6e-6 * row.lower) << row.nu;
  }
}

// The formulas by series and by continued fraction meet at x = nu + 2. The difference of the
// probabilities at two values of x close to it must be their distance times the density.
TEST(ChiSquare, IsOneCurveWhereItsFormulasMeet) {
  for (const double nu : {0.7, 2.0, 7.3, 60.0, 999.0}) {
    const double x = nu + 2.0, h = 1e-4;
    const double density = std::exp((0.5 * nu - 1.0) * std::log(x) - 0.5 * x -
                                    0.5 * nu * std::numbers::ln2 - std::lgamma(0.5 * nu));
    EXPECT_NEAR(chi_square_probability(x + h, nu) - chi_square_probability(x - h, nu),
                2.0 * h * density,
                1e-11)
        << nu;
  }
}

// Above a thousand degrees of freedom the cube-root approximation replaces the exact quantile. The
// step at this limit must be less than a thousandth of the standard deviation, which is sqrt(2/nu)
// of the mean.
TEST(ChiSquare, PassesToTheCubicRootWithoutAStep) {
  for (const double z : {-3.0, -1.645, 0.0, 1.645, 3.0})
    EXPECT_NEAR(
        chi_square_at(z, 1000.001) / chi_square_at(z, 1000.0), 1.0, 1e-3 * std::sqrt(2.0 / 1000.0))
        << z;
}

}  // namespace
}  // namespace latsch::numerics
