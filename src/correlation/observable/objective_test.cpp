// SPDX-License-Identifier: Apache-2.0
#include "correlation/observable/objective.h"

#include <gtest/gtest.h>

#include <cmath>

namespace latsch::correlation {
namespace {

using fe_tire::ModeType;

constexpr double kRound = 1e-14;

ModeRecord mode(double frequency, int n, ModeType type, char phase = ' ') {
  return {frequency, n, type, phase, {}};
}

/// Returns the target (3) for one mode and one force with these relative errors.
double target_of_errors(double frequency, double force) {
  const Comparison modes = compare_modes({mode(100.0, 0, ModeType::lateral)},
                                         {mode(100.0 * (1.0 - frequency), 0, ModeType::lateral)});
  const Comparison stiffness = compare_forces({1000.0}, {{1000.0 * (1.0 - force)}});
  return target({modes, stiffness}, {1.0, 1.0});
}

TEST(CompareForces, IsEquationTwo) {
  const Comparison c = compare_forces({1000.0, 2000.0}, {{900.0, 2100.0}});
  ASSERT_EQ(c.errors.size(), 2u);
  EXPECT_NEAR(c.errors[0], 0.1, kRound);    // (1000 - 900) / 1000
  EXPECT_NEAR(c.errors[1], -0.05, kRound);  // (2000 - 2100) / 2000
  EXPECT_NEAR(c.value, 0.075, kRound);
  EXPECT_NEAR(c.largest_error, 0.1, kRound);
}

TEST(CompareForces, WithTheExponentOfEquationThreeIsTheMeanRoot) {
  ObjectiveSettings settings;
  settings.exponent = 0.5;
  const Comparison c = compare_forces({1000.0, 1000.0}, {{980.0, 1020.0}}, settings);
  EXPECT_NEAR(c.value, std::sqrt(0.02), kRound);  // a 2 % error becomes 14 %
  EXPECT_NEAR(c.mean_error, 0.02, kRound);
}

TEST(CompareForces, AsRootsHalvesASmallError) {
  ObjectiveSettings settings;
  settings.compared = Compared::root_force;
  const Comparison c = compare_forces({1000.0}, {{810.0}}, settings);
  EXPECT_NEAR(c.value, 0.1, kRound);  // 1 - sqrt(0.81)
  EXPECT_NEAR(c.mean_error, 0.19, kRound);
}

TEST(CompareForces, TakesATireThatPullsForNoForce) {
  ObjectiveSettings settings;
  settings.compared = Compared::root_force;
  EXPECT_NEAR(compare_forces({1000.0}, {{-5.0}}, settings).value, 1.0, kRound);
}

TEST(CompareModes, IsEquationOneAfterReorderingSwappedModes) {
  const std::vector<ModeRecord> measured = {mode(40.0, 0, ModeType::torsional),
                                            mode(50.0, 1, ModeType::lateral)};
  const std::vector<ModeRecord> simulated = {mode(44.0, 1, ModeType::lateral),
                                             mode(48.0, 0, ModeType::torsional)};
  const Comparison c = compare_modes(measured, simulated);
  EXPECT_NEAR(c.errors[0], -0.2, kRound);  // (40 - 48) / 40
  EXPECT_NEAR(c.errors[1], 0.12, kRound);  // (50 - 44) / 50
  EXPECT_NEAR(c.value, 0.16, kRound);
}

TEST(CompareModes, CountsAMissingModeAsSet) {
  ObjectiveSettings settings;
  settings.missing_mode = 0.5;
  const Comparison c =
      compare_modes({mode(40.0, 0, ModeType::torsional), mode(80.0, 2, ModeType::radial)},
                    {mode(40.0, 0, ModeType::torsional), mode(80.0, 3, ModeType::radial)},
                    settings);
  EXPECT_NEAR(c.value, 0.25, kRound);
  EXPECT_EQ(c.pairing.missing, std::vector<int>{1});
  EXPECT_EQ(c.pairing.extra, std::vector<int>{1});
}

// The published results are: errors of 13 % in frequency and 2 % in force give a target of 7.4 %; 2
// % and 2 % give 2 %. Errors are printed in whole percent, so the mean of two is known to half a
// percent.
TEST(Target, OfThePublishedErrorsIsThePublishedTarget) {
  EXPECT_NEAR(target_of_errors(0.13, 0.02), 0.074, 0.005);
  EXPECT_NEAR(target_of_errors(0.02, 0.02), 0.02, 0.005);
}

// A third published row, 25 % and 2 % giving 15 %, agrees neither with this formula, which gives
// 13.5 %, nor with the root of the force error, which gives 19.6 %. The difference is larger than
// its digits allow.
TEST(Target, DoesNotExplainThePublishedRowOfTwentyFivePercent) {
  EXPECT_NEAR(target_of_errors(0.25, 0.02), 0.135, kRound);
  EXPECT_GT(0.15 - target_of_errors(0.25, 0.02), 0.005 + 0.005);
  EXPECT_NEAR(0.5 * (0.25 + std::sqrt(0.02)), 0.196, 0.001);
}

TEST(WeightedResiduals, TheirSquaresAreTheTargetOfSquares) {
  ObjectiveSettings squares;
  squares.exponent = 2.0;
  ObjectiveSettings roots = squares;
  roots.compared = Compared::root_force;
  const std::vector<Comparison> comparisons = {
      compare_forces({1000.0, 2000.0, 500.0}, {{900.0, 2100.0, 530.0}}, squares),
      compare_forces({1000.0, 4000.0}, {{810.0, 4100.0}}, roots)};
  const std::vector<double> weights = {3.0, 0.5};
  double sum = 0.0;
  for (double r : weighted_residuals(comparisons, weights)) sum += r * r;
  EXPECT_NEAR(sum, target(comparisons, weights), kRound);
}

TEST(Target, IsTheWeightedMean) {
  Comparison a, b;
  a.value = 0.1;
  b.value = 0.4;
  EXPECT_NEAR(target({a, b}, {2.0, 1.0}), 0.2, kRound);
}

TEST(Target, SaysWhatItIsTheMeanOf) {
  EXPECT_EQ(target_in_words({1.0, 1.0}, 0.03), "mean of the errors");
  EXPECT_EQ(target_in_words({2.0}, 6e-4), "mean square of the errors, its root 2.45 %");
  EXPECT_EQ(target_in_words({0.5}, 0.1), "mean of the errors to the power 0.5, its root 1 %");
  EXPECT_EQ(target_in_words({1.0, 2.0}, 0.1),
            "mean of the errors, each to the exponent of its experiment");
}

}  // namespace
}  // namespace latsch::correlation
