// SPDX-License-Identifier: Apache-2.0
#include "nist_strd/nist_strd.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>

#include "optimization/trust_region/residual_trust_region.h"

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
    // The certified parameters b have eleven digits. In data that are exact to more digits, such as
    // those of Lanczos, only rounding remains in the sum of squares.
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

TEST(NistStrd, ResidualTrustRegionFindsTheCertifiedValues) {
  for (const more_wild::Problem& problem : problems()) {
    if (problem.name != "Misra1a, start 1" && problem.name != "Thurber, start 2" &&
        problem.name != "Rat43, start 2") {
      continue;
    }
    ResidualTrustRegion method(
        more_wild::space(problem),
        {.initial_radius = 1.0 / more_wild::kBoxWidth, .step_tolerance = 1e-11});
    DesignPoint best;
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 100 * (problem.n() + 1) && !method.converged(); ++k) {
      const DesignPoint point = method.propose(1).front();
      const Score score{problem.value(point.values), problem.residuals(point.values)};
      if (score.value < least) {
        least = score.value;
        best = point;
      }
      method.observe(point, score);
    }
    const Dataset data = read_dataset(problem.name.substr(0, problem.name.find(',')));
    // The method ends if a step promises less than 1e-6 of the sum of squares. A relative error e
    // of the parameters b changes the sum by e^2, so b has half the digits of the sum.
    EXPECT_NEAR(least, data.sum, 1e-6 * data.sum) << problem.name;
    for (int i = 0; i < problem.n(); ++i) {
      EXPECT_NEAR(best.values[i] / data.certified[i], 1.0, 1e-3) << problem.name;
    }
  }
}

}  // namespace
}  // namespace latsch::nist_strd
