// SPDX-License-Identifier: Apache-2.0
// Compares Magic Formula 5.2, 6.1 and 6.2 with an independent program, in every sign convention,
// inside and outside the validity ranges of the files, at low, zero and backward speed.
#include "magic_formula/magic_formula_points.h"

#include <gtest/gtest.h>

#include "models/magic_formula/slope_differences_testing.h"

namespace latsch::verification {
namespace {

using namespace magic_formula;

class Points : public testing::TestWithParam<Version> {};

TEST_P(Points, AgreeWithMfevalToTheReach) {
  const auto tire = sample_tire(GetParam());
  if (!tire) GTEST_SKIP() << "no sample tires in " << LATSCH_SAMPLE_TIRES;
  int points = 0;
  for (const MagicFormulaPoint& point : magic_formula_points()) {
    if (point.version != GetParam()) continue;
    ++points;
    const SteadyState found = MagicFormula(*tire, point.conventions).evaluate(point.state);
    const Disagreement d = disagreement(point, found);
    EXPECT_LE(d.force, 1.0) << d.worst;
    EXPECT_LE(d.moment, 1.0) << d.worst;
    EXPECT_LE(d.radius, 1.0) << d.worst;
  }
  EXPECT_GE(points, 200);
}

INSTANTIATE_TEST_SUITE_P(MagicFormula,
                         Points,
                         testing::Values(Version::mf52, Version::mf61, Version::mf62),
                         [](const auto& info) {
                           return info.param == Version::mf52   ? "Mf52"
                                  : info.param == Version::mf61 ? "Mf61"
                                                                : "Mf62";
                         });

/// Compares the derivatives of all outputs of the sample tires in those states with differences of
/// the function without derivatives, one variable at a time.
TEST_P(Points, SlopesAreWhatDifferencesTendTo) {
  const auto tire = sample_tire(GetParam());
  if (!tire) GTEST_SKIP() << "no sample tires in " << LATSCH_SAMPLE_TIRES;
  for (int convention = 0; convention < 8; ++convention) {
    Conventions c;
    c.limits = convention & 1;
    c.angles = convention & 2 ? Angles::tangent : Angles::direct;
    c.turn_slip = convention & 4;
    std::vector<State> states;
    for (const MagicFormulaPoint& point : magic_formula_points())
      if (point.version == GetParam() && states.size() < 120) states.push_back(point.state);
    const SlopeComparison compared = compare_with_differences(MagicFormula(*tire, c), states);
    EXPECT_LE(compared.worst, 1.0) << compared.where << " convention " << convention;
    EXPECT_LE(compared.kinks, 0.01 * compared.count);
    EXPECT_GT(compared.count, 400000);
    EXPECT_EQ(compared.not_the_bits, 0);
  }
}

/// Published values of the 6.1 and 5.2 sample tires in the sign convention of MF-Tyre.
TEST(MagicFormula, PublishedSamples) {
  struct Sample {
    Version version;
    State state;
    double Fx, Fy, Mx, My, Mz;
  };
  const std::vector<Sample> samples = {{Version::mf61,
                                        {4051.2, -0.3, -0.2, 0.0, 0.0, 16.6, 2.6e5},
                                        -3473.4884,
                                        2182.4105,
                                        -39.64644,
                                        -18.00480,
                                        7.12944},
                                       {Version::mf61,
                                        {6752.0, -0.15, 0.0, 0.0, 0.0, 16.6, 2.6e5},
                                        -7274.0178,
                                        -96.5797,
                                        3.28697,
                                        -27.79455,
                                        -0.01697},
                                       {Version::mf61,
                                        {6752.0, -0.075, 0.1, 0.05, 0.0, 16.6, 2.6e5},
                                        -3985.6858,
                                        -4971.0353,
                                        -39.40161,
                                        -27.79455,
                                        -12.79100},
                                       {Version::mf61,
                                        {9452.8, 0.3, 0.2, 0.05, 0.0, 16.6, 2.6e5},
                                        7292.4760,
                                        -4381.0211,
                                        -116.62613,
                                        -36.99717,
                                        -44.52967},
                                       {Version::mf52,
                                        {9416.6, -0.075, 0.1, 0.05, 0.0, 15.0, 2.2e5},
                                        -4776.7419,
                                        -5662.3338,
                                        -182.90572,
                                        -37.66640,
                                        -95.24298}};
  for (const Sample& sample : samples) {
    const auto tire = sample_tire(sample.version);
    if (!tire) GTEST_SKIP() << "no sample tires in " << LATSCH_SAMPLE_TIRES;
    const SteadyState s = MagicFormula(*tire).evaluate(sample.state);
    EXPECT_NEAR(s.Fx, sample.Fx, 0.6e-4);  // half of the last published digit
    EXPECT_NEAR(s.Fy, sample.Fy, 0.6e-4);
    EXPECT_NEAR(s.Mx, sample.Mx, 0.6e-5);
    EXPECT_NEAR(s.My, sample.My, 0.6e-5);
    EXPECT_NEAR(s.Mz, sample.Mz, 0.6e-5);
  }
}

}  // namespace
}  // namespace latsch::verification
