// SPDX-License-Identifier: Apache-2.0
#include "correlation/posterior/sampled_bands.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/scratch_folder_testing.h"
#include "correlation/posterior/linear_posterior_testing.h"
#include "numerics/dense/cholesky.h"

namespace latsch::correlation {
namespace {

/// Slopes of the forces of `press`, then of `alone`, by a, b and c.
Eigen::MatrixXd force_slopes() {
  Eigen::MatrixXd G = Eigen::MatrixXd::Zero(6, 3);
  for (int k = 0; k < 4; ++k) G.row(k) << kPressedAt[static_cast<std::size_t>(k)], 1.0, 0.0;
  for (int k = 0; k < 2; ++k) G.row(4 + k) << 0.0, 1.0, kAloneAt[static_cast<std::size_t>(k)];
  return G;
}

/// Deviations of the measured forces, N.
Eigen::VectorXd force_noise() {
  Eigen::VectorXd sigma(6);
  int row = 0;
  for (const double force : linear_forces(kLinearFit, false)) sigma[row++] = 0.05 * force;
  for (const double force : linear_forces(kLinearFit, true)) sigma[row++] = 0.08 * force;
  return sigma;
}

// The posterior is normal with the covariance C = (G' W G)^-1, so a force has the band
// F +- 1.96 sqrt(g' C g), which is the linear one.
TEST(SampledBands, OfALinearModelAreTheLinearOnes) {
  const ScratchFolder folder;
  Study study = linear_study();
  study.posterior.samples = 4000;
  const auto posterior = sampled_linear(study, folder / "linear.latsch");
  ASSERT_TRUE(posterior);
  ASSERT_EQ(posterior->check.verdict, SurrogateVerdict::stands);
  const Eigen::MatrixXd G = force_slopes();
  const Eigen::MatrixXd weighted = force_noise().cwiseInverse().asDiagonal() * G;
  const numerics::Cholesky information(weighted.transpose() * weighted);
  ASSERT_EQ(posterior->bands.size(), 2U);
  int row = 0;
  for (const SampledBand& band : posterior->bands) {
    const auto forces = linear_forces(kLinearFit, band.experiment == 1);
    ASSERT_EQ(band.lower.size(), forces.size());
    for (std::size_t k = 0; k < forces.size(); ++k, ++row) {
      const double deviation =
          information.solve_lower(Eigen::VectorXd(G.row(row).transpose())).norm();
      EXPECT_NEAR(band.lower[k], forces[k] - 1.96 * deviation, 0.15 * deviation) << row;
      EXPECT_NEAR(band.median[k], forces[k], 0.1 * deviation) << row;
      EXPECT_NEAR(band.upper[k], forces[k] + 1.96 * deviation, 0.15 * deviation) << row;
    }
  }
}

// With an offset of deviation tau that the recording adds, the noise of `press` has the covariance
// diag(sigma^2) + tau^2 1 1', and a is as uncertain as generalized least squares say. Without the
// prior of the offset b and the offset could not be told apart at all.
TEST(Posterior, IntegratesANuisanceNumberWithItsPrior) {
  const ScratchFolder folder;
  constexpr double kTau = 6.0;
  Study study = linear_study();
  study.posterior.samples = 10'000;
  study.experiments[0].nuisance.numbers = {{NuisanceKind::offset, kTau, "N"}};
  const auto posterior = sampled_linear(study, folder / "offset.latsch");
  ASSERT_TRUE(posterior) << posterior.failure().reason;
  Eigen::MatrixXd covariance = force_noise().array().square().matrix().asDiagonal();
  covariance.topLeftCorner(4, 4).array() += kTau * kTau;
  const numerics::Cholesky noise(covariance);
  const Eigen::MatrixXd G = force_slopes();
  const Eigen::MatrixXd whitened = noise.solve_lower(G);
  const numerics::Cholesky information(whitened.transpose() * whitened);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const double width =
        study.space[static_cast<int>(i)].upper - study.space[static_cast<int>(i)].lower;
    const double deviation =
        information.solve_lower(Eigen::VectorXd(Eigen::VectorXd::Unit(3, i))).norm();
    const PosteriorShape& shape = posterior->shapes[at];
    EXPECT_NEAR(shape.deviation * width, deviation, 0.05 * deviation) << i;
    EXPECT_NEAR(
        posterior->value_at(study.space, at, shape.mean), kLinearFit.values[at], 0.08 * deviation)
        << i;
  }
}

}  // namespace
}  // namespace latsch::correlation
