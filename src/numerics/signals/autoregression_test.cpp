// SPDX-License-Identifier: Apache-2.0
#include "numerics/signals/autoregression.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

namespace latsch::numerics {
namespace {

/// Returns the correlation matrix of an autoregression of order 2, by the Yule-Walker equations:
/// rho_1 = phi_1 / (1 - phi_2), rho_k = phi_1 rho_{k-1} + phi_2 rho_{k-2}.
Eigen::MatrixXd correlations(double phi1, double phi2, int count) {
  std::vector<double> rho{1.0, phi1 / (1.0 - phi2)};
  for (int k = 2; k < count; ++k) rho.push_back(phi1 * rho[k - 1] + phi2 * rho[k - 2]);
  Eigen::MatrixXd R(count, count);
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j) R(i, j) = rho[std::abs(i - j)];
  }
  return R;
}

// The partial autocorrelations are kappa_2 = phi_2 and kappa_1 = phi_1 / (1 - phi_2).
TEST(Autoregression, WhitensWithTheRootOfItsCorrelationMatrix) {
  const double phi1 = 1.1, phi2 = -0.4;
  const Autoregression noise({phi1 / (1.0 - phi2), phi2});
  const int n = 7;
  const Eigen::MatrixXd R = correlations(phi1, phi2, n), one = Eigen::MatrixXd::Identity(n, n);
  const Eigen::MatrixXd W = noise.whitened(one);  // L^-1
  EXPECT_TRUE((W * R * W.transpose()).isApprox(one, 1e-12));
  const Eigen::MatrixXd C = noise.colored(one);  // L'
  EXPECT_TRUE((C.transpose() * C).isApprox(R, 1e-12));
  EXPECT_NEAR(noise.log_determinant(n), std::log(R.determinant()), 1e-12);
}

TEST(Autoregression, OfOrderOneOneSampleInAFewIsNew) {
  EXPECT_NEAR(Autoregression({0.8}).samples_for_one(), (1 + 0.8) / (1 - 0.8), 1e-12);
  EXPECT_EQ(Autoregression().samples_for_one(), 1.0);
}

}  // namespace
}  // namespace latsch::numerics
