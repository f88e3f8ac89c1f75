// SPDX-License-Identifier: Apache-2.0
#include "optimization/posterior/model_chains.h"

#include <gtest/gtest.h>

#include <cmath>

#include "optimization/problem/point_vector.h"

namespace latsch {
namespace {

/// A curved valley: v = 3 x^2 is known five times as well as x.
double squares_of_banana(const Eigen::VectorXd& u) {
  const double x = u[0] - 0.5, v = u[1] - 0.3;
  return std::pow(x / 0.15, 2) + std::pow((v - 3.0 * x * x) / 0.03, 2);
}

/// A straight density that covers the banana.
double straight_density(const Eigen::VectorXd& u) {
  return -0.5 * (std::pow((u[0] - 0.5) / 0.25, 2) + std::pow((u[1] - 0.4) / 0.2, 2));
}

Eigen::MatrixXd starts_around(const Eigen::VectorXd& center, double spread) {
  RandomStream random(5, 0);
  Eigen::MatrixXd starts(center.size(), 40);
  for (Eigen::Index k = 0; k < starts.cols(); ++k)
    for (Eigen::Index i = 0; i < center.size(); ++i)
      starts(i, k) = center[i] + spread * random.normal();
  return starts;
}

/// Answers all questions; points with x above `edge` fail.
ModelChains run_on_banana(const LogDensityAt& surrogate,
                          const ModelChainOptions& options,
                          double edge) {
  ModelChains chains(starts_around(to_vector({0.5, 0.3}), 0.02), {}, surrogate, options);
  while (!chains.wanted().empty()) {
    std::vector<std::optional<double>> sums;
    for (const Eigen::VectorXd& u : chains.wanted())
      sums.push_back(u[0] > edge ? std::nullopt : std::optional(squares_of_banana(u)));
    chains.observe(sums);
  }
  return chains;
}

/// Returns the quantile of one variable of the banana in the unit square, cut off at `edge`, on a
/// grid.
double banana_quantile(Eigen::Index variable, double p, double edge) {
  constexpr int kCells = 600;
  Eigen::VectorXd marginal = Eigen::VectorXd::Zero(kCells);
  for (int i = 0; i < kCells; ++i) {
    for (int j = 0; j < kCells; ++j) {
      Eigen::VectorXd u(2);
      u[variable] = (i + 0.5) / kCells;
      u[1 - variable] = (j + 0.5) / kCells;
      if (u[0] <= edge) marginal[i] += std::exp(-0.5 * squares_of_banana(u));
    }
  }
  marginal /= marginal.sum();
  double sum = 0.0;
  int i = 0;
  while (sum + marginal[i] < p) sum += marginal[i++];
  return (i + (p - sum) / marginal[i]) / kCells;
}

void expect_banana(const PosteriorSamples& samples, double edge, double tolerance) {
  for (Eigen::Index i = 0; i < 2; ++i) {
    const Eigen::VectorXd x = samples.u.row(i).transpose();
    const double deviation = std::sqrt((x.array() - x.mean()).square().mean());
    for (const double p : {0.025, 0.5, 0.975})
      EXPECT_NEAR(quantile_of(x, p), banana_quantile(i, p, edge), tolerance * deviation)
          << i << ' ' << p;
  }
}

// The straight surrogate knows nothing of the curvature; the ratio of the model puts it right.
TEST(ModelChains, DelayedAcceptanceSamplesABananaAsQuadratureIntegratesItByAWrongSurrogate) {
  const auto chains = run_on_banana(
      straight_density, {.trials = 200'000, .samples = 40'000, .ends_when_mixed = false}, 1.0);
  const PosteriorSamples samples = chains.samples();
  EXPECT_TRUE(samples.unmixed.empty());
  EXPECT_LT(chains.accepted(), 0.9);
  expect_banana(samples, 1.0, 0.15);
}

TEST(ModelChains, WithoutASurrogateSampleABananaAsQuadratureIntegratesIt) {
  const auto chains =
      run_on_banana({}, {.trials = 1'000'000, .samples = 40'000, .ends_when_mixed = false}, 1.0);
  const PosteriorSamples samples = chains.samples();
  EXPECT_TRUE(samples.unmixed.empty());
  expect_banana(samples, 1.0, 0.15);
}

// If the surrogate is the model, every proposal is accepted, and a walker forgets its place in one.
TEST(ModelChains, ARightSurrogateNeedsFewTrialsAndAcceptsEachProposal) {
  const auto chains =
      run_on_banana([](const Eigen::VectorXd& u) { return -0.5 * squares_of_banana(u); },
                    {.trials = 4000, .samples = 4000},
                    1.0);
  EXPECT_GT(chains.accepted(), 0.75);  // all of (1), and some of (2)
  EXPECT_TRUE(chains.samples().unmixed.empty());
  EXPECT_LT(chains.trials(), 4000);
  expect_banana(chains.samples(), 1.0, 0.25);
}

// A failed trial has density 0: the samples are those of the rest.
TEST(ModelChains, LeaveOutWhereTheModelFails) {
  constexpr double kEdge = 0.55;
  const auto chains =
      run_on_banana({}, {.trials = 200'000, .samples = 40'000, .ends_when_mixed = false}, kEdge);
  EXPECT_GT(chains.failed(), 0);
  EXPECT_LE(chains.samples().u.row(0).maxCoeff(), kEdge);
  expect_banana(chains.samples(), kEdge, 0.15);
}

TEST(ModelChains, SayThatTheyDoNotMixAfterTooFewTrials) {
  const auto chains = run_on_banana({}, {.trials = 400}, 1.0);
  EXPECT_LE(chains.trials(), 400);
  EXPECT_EQ(chains.samples().unmixed.size(), 2U);
}

// A surrogate that is far too narrow leaves the walkers near their starts.
TEST(ModelChains, SayThatTheyDoNotMixIfTheWalkersRememberTheirStarts) {
  const auto narrow = [](const Eigen::VectorXd& u) {
    return -0.5 * (u - to_vector({0.5, 0.3})).squaredNorm() / std::pow(0.002, 2);
  };
  const auto chains = run_on_banana(narrow, {.trials = 4000}, 1.0);
  EXPECT_FALSE(chains.samples().unmixed.empty());
}

TEST(ModelChains, EndWithoutSamplesIfTheModelHasNoDensityAtTheStarts) {
  const auto chains = run_on_banana({}, {.trials = 4000}, 0.0);
  EXPECT_FALSE(chains.has_density());
  EXPECT_EQ(chains.trials(), 40);
}

TEST(ModelChains, HaveTheSameBitsAgain) {
  const ModelChainOptions options{.trials = 2000, .samples = 500, .seed = 7};
  const auto first = run_on_banana(straight_density, options, 1.0).samples();
  EXPECT_EQ(first.u, run_on_banana(straight_density, options, 1.0).samples().u);
  ModelChainOptions other = options;
  other.seed = 8;
  EXPECT_NE(first.u, run_on_banana(straight_density, other, 1.0).samples().u);
}

}  // namespace
}  // namespace latsch
