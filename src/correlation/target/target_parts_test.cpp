// SPDX-License-Identifier: Apache-2.0
// The target assembled from its parts equals that of objective() at any weights.
#include "correlation/target/target_parts.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "correlation/search/study_reuse_testing.h"
#include "correlation/target/residuals.h"

namespace latsch::correlation {
namespace {

class PartsOfTarget : public FittedStudy {
 protected:
  /// Returns a second experiment of the same test with other settings, and the noise of both
  /// experiments.
  static std::string more(const std::string& noise, const std::string& other_noise) {
    return noise + R"(
[experiment.aligning]
kind = "curve"
y = "steady/Mz"
measurement = "aligning.csv"
exponent = 2
weight = 0.25
)" + other_noise;
  }

  Study two_experiments(const std::string& noise, const std::string& other_noise) {
    std::string text = "Mz [N*m]\n";
    for (int i = -12; i <= 12; ++i) text += std::to_string(2.5 * i) + "\n";
    write("aligning.csv", text);
    return read(more(noise, other_noise));
  }

  void expect_same_at_any_weights(Study study) {
    const PartedTarget parted(study);
    const DesignPoint point{{1.1, -18.0}};
    const auto channels = evaluator(study)(point);
    ASSERT_TRUE(channels);
    const auto parts = parted.parts(point, *channels);
    ASSERT_TRUE(parts);
    for (const auto& weights :
         std::vector<std::vector<double>>{{1.0, 0.25}, {0.0, 1.0}, {3.0, 2e-3}}) {
      for (std::size_t e = 0; e < weights.size(); ++e)
        study.experiments[e].objective.weight = weights[e];
      const auto weighting = parted.weighting(weights);
      const double expected = objective(study)(point, *channels)->value;
      EXPECT_NEAR(weighting.target(*parts), expected, 1e-13 * expected);
      EXPECT_NEAR(
          weighting.share(*parts, 0) + weighting.share(*parts, 1), expected, 1e-13 * expected);
    }
  }
};

TEST_F(PartsOfTarget, WithoutNoise) { expect_same_at_any_weights(two_experiments("", "")); }

TEST_F(PartsOfTarget, WithNoiseAndARobustLoss) {
  expect_same_at_any_weights(
      two_experiments("noise = \"3 %\"\nloss = \"huber\"\n", "noise = \"2 N*m\"\n"));
}

/// The value of the target, the weighted residuals, and the residuals of the intervals must agree.
/// The latter are in units of the noise and not divided by the sum of weights.
TEST_F(PartsOfTarget, ValueResidualsAndIntervalsAgreeToRounding) {
  for (const bool has_noise : {false, true}) {
    const Study study =
        has_noise ? two_experiments("exponent = 2\nnoise = \"3 %\"\n", "noise = \"2 N*m\"\n")
                  : two_experiments("exponent = 2\n", "");
    const DesignPoint point{{1.1, -18.0}};
    const auto channels = evaluator(study)(point);
    ASSERT_TRUE(channels);
    const auto of_target = objective(study)(point, *channels);
    const auto of_intervals = residual_objective(study)(point, *channels);
    ASSERT_TRUE(of_target && of_intervals);
    double squares = 0.0;
    for (const double r : of_target->residuals) squares += r * r;
    EXPECT_NEAR(
        squares, of_target->value, 4e-16 * std::sqrt(of_target->residuals.size()) * squares);
    ASSERT_EQ(of_target->residuals.size(), of_intervals->residuals.size());
    const double factor = std::sqrt(of_target->value / of_intervals->value);
    for (std::size_t i = 0; i < of_target->residuals.size(); ++i)
      EXPECT_NEAR(of_target->residuals[i],
                  factor * of_intervals->residuals[i],
                  4e-15 * std::abs(of_target->residuals[i]));
  }
}

/// Only the priors are divided by the sum of the weights: with twice the weights their contribution
/// is half as large.
TEST_F(PartsOfTarget, PriorsCountAgainstTheSumOfWeights) {
  const PartedTarget parted(two_experiments("", ""));
  const TargetParts priors{{0.0, 0.0}, {}, {}, 2.0};
  EXPECT_DOUBLE_EQ(parted.weighting({1.0, 0.25}).target(priors), 2.0 / 1.25);
  EXPECT_DOUBLE_EQ(parted.weighting({2.0, 0.5}).target(priors), 2.0 / 2.5);
}

/// Only ratios of weights matter for measured values, also at the limits of floating-point numbers.
TEST_F(PartsOfTarget, WeightsOfAnySize) {
  const PartedTarget parted(two_experiments("", ""));
  const TargetParts parts{{0.5, 0.25}, {}, {}};
  for (const double size : {1e308, 1e-308, 5e-324})
    EXPECT_DOUBLE_EQ(parted.weighting({size, size}).target(parts), 0.375) << size;
}

TEST_F(PartsOfTarget, WeightsThatAreNoneAreRefused) {
  const PartedTarget parted(two_experiments("", ""));
  EXPECT_THROW(parted.weighting({0.0, 0.0}), InputError);
  EXPECT_THROW(parted.weighting({-1.0, 2.0}), InputError);
  EXPECT_THROW(parted.weighting({std::nan(""), 2.0}), InputError);
}

}  // namespace
}  // namespace latsch::correlation
