// SPDX-License-Identifier: Apache-2.0
#include "correlation/posterior/predictive_check.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "base/scratch_folder_testing.h"
#include "correlation/posterior/linear_posterior_testing.h"
#include "numerics/chi_square.h"

namespace latsch::correlation {
namespace {

/// Returns the study without `alone` and without c: four forces that depend on a and b.
Study pressed_study(const std::vector<double>& offsets) {
  Study study = linear_study(offsets);
  study.experiments.pop_back();
  study.space = DesignSpace({{"a", {"a"}, -2e4, 2e4, 4e3}, {"b", {"a"}, -3e2, 3e2, 30.0}});
  study.target_key = "pressed springs";
  return study;
}

PredictiveCheck check_of(const Study& study, const DesignPoint& fit) {
  const ScratchFolder folder;
  Journal journal = Journal::open(folder / "pressed.latsch", kLinearSprings);
  InlineExecutor executor([](const DesignPoint& point) -> Result<Channels> {
    Channels channels;
    channels.add({"press/force", "N", linear_forces(point, false)});
    return channels;
  });
  const auto found = sample_posterior(study, fit, executor, journal, {});
  EXPECT_TRUE(found && *found);
  return (*found)->checks.at(0);
}

// Offsets of the sign + - - + times x leave a sum of squares S at the fit. At a sample the sum is
// S + chi^2 with two degrees of freedom, so the rank is the integral of F_4(S + x) over x.
TEST(PredictiveCheck, RanksALinearModelAsTheIntegralOverItsSamples) {
  std::vector<double> offsets, forces = linear_forces(kLinearFit, false);
  for (std::size_t k = 0; k < 4; ++k)
    offsets.push_back((k == 0 || k == 3 ? 0.06 : -0.06) * forces[k]);
  const Study study = pressed_study(offsets);
  // the fit by least squares, weighted by 5 % of the measured forces
  double xx = 0, x1 = 0, one = 0, xy = 0, y1 = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const double F = forces[k] + offsets[k], w = std::pow(0.05 * F, -2), x = kPressedAt[k];
    xx += w * x * x;
    x1 += w * x;
    one += w;
    xy += w * x * F;
    y1 += w * F;
  }
  const double det = xx * one - x1 * x1;
  const DesignPoint fit{{(xy * one - x1 * y1) / det, (xx * y1 - x1 * xy) / det}};
  double S = 0.0;
  for (std::size_t k = 0; k < 4; ++k) {
    const double F = forces[k] + offsets[k];
    S += std::pow((F - fit.values[0] * kPressedAt[k] - fit.values[1]) / (0.05 * F), 2);
  }
  double expected = 0.0;
  constexpr int kPoints = 2000;
  for (int k = 0; k < kPoints; ++k)
    expected += numerics::chi_square_probability(S - 2.0 * std::log((k + 0.5) / kPoints),
                                                 4) /  // chi^2 of two: -2 ln p
                kPoints;
  const PredictiveCheck check = check_of(study, fit);
  EXPECT_EQ(check.values, 4);
  ASSERT_TRUE(check.rank.has_value());
  EXPECT_NEAR(*check.rank, expected, 0.02);
  EXPECT_NEAR(check.chi_square, (S + 2.0) / 4.0, 0.1);
  EXPECT_FALSE(check.is_refused());
}

/// Whitened residuals of the four forces, one column for each of 500 samples.
Eigen::MatrixXd white_residuals(double deviation) {
  RandomStream random(3, 0);
  Eigen::MatrixXd r(4, 500);
  for (double& one : r.reshaped()) one = deviation * random.normal();
  return r;
}

TEST(PredictiveCheck, NamesDataThatNoNoiseOfTheStatedSizeMakes) {
  const Study study = pressed_study({0.0, 0.0, 0.0, 0.0});
  const std::vector<Eigen::Index> rows{0, 1, 2, 3};
  const auto check = [&](double deviation) {
    return predictive_checks(study, rows, white_residuals(deviation), 1.0).at(0);
  };
  EXPECT_FALSE(check(1.0).is_refused());
  EXPECT_TRUE(check(1.0).in_words().starts_with("data as the model makes them (rank of chi^2 0.5"));
  EXPECT_NEAR(*check(1.0).rank, 0.5, 0.05);
  EXPECT_TRUE(check(10.0).is_refused());
  EXPECT_NE(check(10.0).in_words().find("farther from it"), std::string::npos);
  EXPECT_TRUE(check(0.05).is_refused());
  EXPECT_NE(check(0.05).in_words().find("nearer to it"), std::string::npos);
}

// An unknown size of the noise is that of all residuals together: an experiment alone says nothing,
// and of two, that with the larger residuals is refused.
TEST(PredictiveCheck, JudgesByTheOtherExperimentsIfTheNoiseIsUnknown) {
  const Study alone = pressed_study({0.0, 0.0, 0.0, 0.0});
  const auto one = predictive_checks(alone, {0, 1, 2, 3}, white_residuals(1.0), std::nullopt);
  EXPECT_FALSE(one.at(0).rank.has_value());
  EXPECT_FALSE(one.at(0).is_refused());
  EXPECT_NE(one.at(0).in_words().find("not judged"), std::string::npos);
  const Study both = linear_study();
  Eigen::MatrixXd r(6, 500);
  r << white_residuals(1.0), white_residuals(1.0).topRows(2);
  const std::vector<Eigen::Index> rows{0, 1, 2, 3, 4, 5};
  for (const PredictiveCheck& check : predictive_checks(both, rows, r, std::nullopt))
    EXPECT_FALSE(check.is_refused()) << check.experiment;
  r.bottomRows(2) *= 1e3;
  const auto far = predictive_checks(both, rows, r, std::nullopt);
  EXPECT_LT(*far.at(0).rank, kLeastRank);
  // alone in the sum, T = S, its rank is E F_2(X) = 1 - E exp(-X / 2) = 1 - 2^-3 for X of 6 degrees
  EXPECT_NEAR(*far.at(1).rank, 0.875, 0.005);
}

}  // namespace
}  // namespace latsch::correlation
