// SPDX-License-Identifier: Apache-2.0
#include "optimization/posterior/chain_diagnostics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "optimization/problem/point_vector.h"

namespace latsch {
namespace {

/// Returns M chains of an autoregression x_t = rho x_{t-1} + e of variance 1.
Eigen::MatrixXd autoregressive_chains(Eigen::Index N, Eigen::Index M, double rho) {
  Eigen::MatrixXd chains(N, M);
  for (Eigen::Index j = 0; j < M; ++j) {
    RandomStream random(5, static_cast<std::uint64_t>(j));
    chains(0, j) = random.normal();
    for (Eigen::Index i = 1; i < N; ++i)
      chains(i, j) = rho * chains(i - 1, j) + std::sqrt(1.0 - rho * rho) * random.normal();
  }
  return chains;
}

TEST(ChainDiagnostics, CountsIndependentDrawsAsTheyAre) {
  const ChainDiagnostics d = chain_diagnostics(autoregressive_chains(1000, 8, 0.0));
  EXPECT_NEAR(d.bulk, 8000.0, 800.0);  // the estimate scatters by some percent
  EXPECT_NEAR(d.tail, 8000.0, 1200.0);
  EXPECT_LT(d.rhat, 1.005);
}

// The mean of N draws of an autoregression is as exact as that of N (1 - rho) / (1 + rho)
// independent ones.
TEST(ChainDiagnostics, CountsCorrelatedDrawsByTheClosedFormOfAnAutoregression) {
  for (const double rho : {0.5, 0.9, -0.3}) {
    const double expected = 40.0 * 2000.0 * (1.0 - rho) / (1.0 + rho);
    EXPECT_NEAR(effective_draws(autoregressive_chains(2000, 40, rho)), expected, 0.1 * expected)
        << rho;
  }
}

// Two chains of N draws 0, 1, 0, 1 ... and d, 1 + d ...: W = N / (4 (N - 1)), B / N = d^2 / 2.
TEST(ChainDiagnostics, RhatOfTwoShiftedChainsIsThatOfItsFormula) {
  constexpr int kDraws = 10;
  constexpr double kShift = 0.7;
  Eigen::MatrixXd chains(kDraws, 2);
  for (int i = 0; i < kDraws; ++i) {
    chains(i, 0) = i % 2;
    chains(i, 1) = i % 2 + kShift;
  }
  const double W = kDraws / (4.0 * (kDraws - 1));
  const double V = (kDraws - 1.0) / kDraws * W + 0.5 * kShift * kShift;
  EXPECT_NEAR(plain_rhat(chains), std::sqrt(V / W), 1e-12);
}

// A drift by d from the first to the last draw moves the means of the halves apart by d / 2 and
// adds (d / 2)^2 / 12 to the variance within each: R-hat^2 = 1 + B / (N W), B / N = d^2 / 16 * 16 /
// 15 for sixteen halves.
TEST(ChainDiagnostics, SeesADriftWithinChainsThatStartAlike) {
  constexpr double kDrift = 1.0;
  Eigen::MatrixXd chains = autoregressive_chains(500, 8, 0.0);
  for (Eigen::Index i = 0; i < chains.rows(); ++i) chains.row(i).array() += kDrift / 500.0 * i;
  EXPECT_LT(plain_rhat(chains), 1.005);
  const double expected = std::sqrt(1.0 + kDrift * kDrift / 15.0 / (1.0 + kDrift * kDrift / 48.0));
  EXPECT_NEAR(chain_diagnostics(chains).rhat, expected, 0.01);
}

TEST(ChainDiagnostics, SeesAChainThatDiffersInSpreadAlone) {
  Eigen::MatrixXd chains = autoregressive_chains(500, 8, 0.0);
  chains.col(3) *= 4.0;
  EXPECT_GT(chain_diagnostics(chains).rhat, 1.01);
}

// Cauchy draws have no variance; their ranks have.
TEST(ChainDiagnostics, ServesDrawsWithoutAVariance) {
  Eigen::MatrixXd chains = autoregressive_chains(1000, 8, 0.0);
  chains = chains.cwiseQuotient(autoregressive_chains(1000, 16, 0.0).rightCols(8));
  const ChainDiagnostics d = chain_diagnostics(chains);
  EXPECT_LT(d.rhat, 1.005);
  EXPECT_NEAR(d.bulk, 8000.0, 1000.0);
}

TEST(ChainDiagnostics, QuantilesInterpolateBetweenSortedValues) {
  const Eigen::VectorXd values = to_vector({3.0, 1.0, 5.0, 2.0, 4.0});
  EXPECT_DOUBLE_EQ(quantile_of(values, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(quantile_of(values, 0.625), 3.5);
  EXPECT_DOUBLE_EQ(quantile_of(values, 1.0), 5.0);
}

}  // namespace
}  // namespace latsch
