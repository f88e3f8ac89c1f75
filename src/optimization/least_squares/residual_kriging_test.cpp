// SPDX-License-Identifier: Apache-2.0
#include "optimization/least_squares/residual_kriging.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "optimization/least_squares/box_least_squares.h"

namespace latsch {
namespace {

/// Returns two residuals, quadratic in three variables.
Eigen::VectorXd quadratic(const Eigen::VectorXd& z) {
  return Eigen::Vector2d(1.0 + 2.0 * z[0] - z[1] + 3.0 * z[0] * z[2] + z[1] * z[1],
                         -2.0 + z[2] + 0.5 * z[0] * z[0] - z[1] * z[2]);
}

Eigen::VectorXd linear(const Eigen::VectorXd& z) {
  return Eigen::Vector2d(1.0 + 2.0 * z[0] - z[1], 3.0 - z[0] + 4.0 * z[2]);
}

template <class Function>
ResidualSamples sample(const Function& function, int count, double noise = 0.0) {
  RandomStream random(7, 0);
  ResidualSamples samples{
      Eigen::MatrixXd(count, 3), Eigen::MatrixXd(count, 2), function(Eigen::Vector3d::Zero()), {}};
  for (int i = 0; i < count; ++i) {
    for (int k = 0; k < 3; ++k) samples.Z(i, k) = 2.0 * random.uniform() - 1.0;
    samples.D.row(i) = function(Eigen::VectorXd(samples.Z.row(i))) - samples.r_c;
    for (int j = 0; j < 2; ++j) samples.D(i, j) += noise * random.normal();
  }
  return samples;
}

TEST(ResidualKriging, IsExactForLinearResidualsFromAsManySamplesAsVariables) {
  const ResidualKriging model(sample(linear, 3), 0.0);
  const Eigen::Vector3d z(0.3, -0.7, 0.5);
  // The prior variance of slopes is 1e4 and that of curvatures 1, so the error of the slopes is
  // about 1e-4.
  EXPECT_LT((model.residuals(z) - linear(z)).norm(), 1e-2);
}

TEST(ResidualKriging, IsExactForQuadraticResidualsFromAsManySamplesAsCoefficients) {
  const ResidualKriging model(sample(quadratic, 9), 0.0);
  const Eigen::Vector3d z(0.3, -0.7, 0.5);
  EXPECT_LT((model.residuals(z) - quadratic(z)).norm(), 1e-2);
}

TEST(ResidualKriging, JacobianIsTheDerivativeOfItsResiduals) {
  const ResidualKriging model(sample(quadratic, 6), 0.0);
  const Eigen::Vector3d z(0.1, 0.2, -0.4);
  const Eigen::MatrixXd J = model.jacobian(z);
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d h = 1e-4 * Eigen::Vector3d::Unit(k);
    const Eigen::VectorXd slope = (model.residuals(z + h) - model.residuals(z - h)) / 2e-4;
    EXPECT_LT((J.col(k) - slope).norm(), 1e-8);  // central differences of a quadratic are exact
  }
}

TEST(ResidualKriging, ExpectsWhatItSaysWhereSamplesAreAndMoreWhereNoneShowed) {
  ResidualSamples samples = sample(linear, 2);
  samples.Z = Eigen::MatrixXd{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
  const ResidualKriging model(samples, 0.0);
  const auto surplus = [&](const Eigen::Vector3d& z) {
    return model.expected(z) - model.residuals(z).squaredNorm();
  };
  EXPECT_EQ(surplus(Eigen::Vector3d::Zero()), 0.0);
  // Along z_3, s^2 = sum d'd / (N (V_g + 1/2)) and v = s^2 (V_g + 1/2 + 1e-4), to terms of 1e-4.
  const double unknown = samples.D.squaredNorm() / 2.0;
  EXPECT_NEAR(surplus(Eigen::Vector3d::UnitZ()), unknown, 1e-3 * unknown);
  EXPECT_LT(surplus(Eigen::Vector3d::UnitX()), 1e-3 * unknown);
}

TEST(ResidualKriging, VarianceHasTheGradientItSays) {
  const ResidualKriging model(sample(quadratic, 4), 0.0);
  const auto variance = [&](const Eigen::Vector3d& z) {
    return model.expected(z) - model.residuals(z).squaredNorm();
  };
  const Eigen::Vector3d z(0.1, 0.2, -0.4);
  const Eigen::VectorXd half = model.variance_gradient(z);
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d h = 1e-3 * Eigen::Vector3d::Unit(k);
    EXPECT_NEAR(2.0 * half[k], (variance(z + h) - variance(z - h)) / 2e-3, 1e-5 * half.norm());
  }
  const Eigen::MatrixXd H = model.variance_hessian(z);
  EXPECT_LT((H - H.transpose()).norm(), 1e-9 * H.norm());
  EXPECT_GT(H.diagonal().minCoeff(), 0.0);
}

TEST(ResidualKriging, TakesKnownSlopes) {
  ResidualSamples samples = sample(quadratic, 6);
  samples.slopes = Eigen::MatrixXd{{2.0, -1.0, 0.0}, {0.0, 0.0, 1.0}};
  const ResidualKriging model(samples, 0.0);
  EXPECT_LT((model.jacobian(Eigen::Vector3d::Zero()) - samples.slopes).norm(), 1e-12);
  const Eigen::Vector3d z(0.3, -0.7, 0.5);  // six samples determine six curvature coefficients
  EXPECT_LT((model.residuals(z) - quadratic(z)).norm(), 1e-2);
}

TEST(ResidualKriging, SaysWhichDirectionIsNotKnown) {
  const SlopeVariance g = slope_variance(Eigen::MatrixXd{{1.0, 1.0, 0.0}, {1.0, -1.0, 0.0}});
  EXPECT_NEAR(g.share[2], 1.0, 1e-9);
  EXPECT_LT(g.share[1], 1e-3);
  EXPECT_NEAR(std::abs(g.directions(2, 2)), 1.0, 1e-9);
}

TEST(ResidualKriging, FindsNoNoiseWhereThereIsNoneAndFindsIt) {
  EXPECT_EQ(likeliest_noise(sample(quadratic, 20)), 0.0);
  EXPECT_GT(likeliest_noise(sample(quadratic, 40, 0.3)), 0.0);
}

TEST(BoxLeastSquares, EndsAtBoundsThatHoldIt) {
  // r = (z0 - 2, z1 + 0.25, z2 - 0.5) has its minimum in the box at (1, -0.25, 0.5).
  ResidualSamples samples;
  samples.Z = Eigen::MatrixXd(0, 3);
  samples.D = Eigen::MatrixXd(0, 3);
  samples.r_c = Eigen::Vector3d(-2.0, 0.25, -0.5);
  samples.slopes = Eigen::Matrix3d::Identity();
  const Eigen::VectorXd z = minimize_in_box(
      ResidualKriging(samples, 0.0), -Eigen::VectorXd::Ones(3), Eigen::VectorXd::Ones(3));
  EXPECT_EQ(z[0], 1.0);
  EXPECT_NEAR(z[1], -0.25, 1e-5);
  EXPECT_NEAR(z[2], 0.5, 1e-5);
}

// If every residual scatters by s, |r|^2 scatters by 2 s |r|.
TEST(ResidualKriging, TellsWhatNoiseMakesOfTheTarget) {
  const Eigen::VectorXd r_c = Eigen::VectorXd::LinSpaced(100, 1.0, 3.0);
  const double s = 0.05;
  RandomStream random(9, 0);
  ResidualSamples samples{Eigen::MatrixXd(20, 3), Eigen::MatrixXd(20, 100), r_c, {}};
  Eigen::MatrixXd J(100, 3);
  for (double& slope : J.reshaped()) slope = 0.1 * random.normal();
  for (int i = 0; i < 20; ++i) {
    for (int k = 0; k < 3; ++k) samples.Z(i, k) = 2.0 * random.uniform() - 1.0;
    samples.D.row(i) = (J * samples.Z.row(i).transpose()).transpose();
  }
  EXPECT_EQ(ResidualKriging(samples, 0.0).target_deviation(), 0.0);
  Eigen::VectorXd here(100);  // noise of the residuals at the center
  for (double& value : here) value = s * random.normal();
  for (int i = 0; i < 20; ++i) {
    for (int j = 0; j < 100; ++j) samples.D(i, j) += s * random.normal() - here[j];
  }
  const ResidualKriging model(samples, likeliest_noise(samples));
  EXPECT_NEAR(model.target_deviation(), 2.0 * s * r_c.norm(), 0.5 * 2.0 * s * r_c.norm());
}

}  // namespace
}  // namespace latsch
