// SPDX-License-Identifier: Apache-2.0
// Tests of the projection against the normal equations of the problem that has all unknowns.
#include "correlation/nuisance/nuisance_projection.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "base/random.h"

namespace latsch::correlation {
namespace {

struct Projected {
  Eigen::MatrixXd A, J, S;  // S: inverse variances of the priors
  Eigen::VectorXd r, sigma;

  explicit Projected(std::uint64_t seed) {
    RandomStream random(seed, 0);
    A.resize(40, 3);
    J.resize(40, 2);
    r.resize(40);
    for (Eigen::Index i = 0; i < 40; ++i) {
      for (Eigen::Index k = 0; k < 3; ++k) A(i, k) = random.normal();
      for (Eigen::Index k = 0; k < 2; ++k) J(i, k) = random.normal();
      r[i] = random.normal();
    }
    sigma = Eigen::Vector3d(0.3, INFINITY, 2.0);
    S = Eigen::Vector3d(1.0 / 0.09, 0.0, 0.25).asDiagonal();
  }
};

TEST(NuisanceProjection, SolvesTheAugmentedNormalEquations) {
  for (std::uint64_t seed = 1; seed < 6; ++seed) {
    const Projected p(seed);
    const NuisanceProjection projection(p.A, p.sigma);
    const Eigen::MatrixXd N = p.A.transpose() * p.A + p.S;
    const Eigen::Vector3d z0(0.1, -0.7, 0.4);
    const Eigen::VectorXd expected = -N.inverse() * (p.A.transpose() * p.r + p.S * z0);
    EXPECT_LT((projection.step(p.r, z0) - expected).norm(), 1e-12);
    EXPECT_LT((projection.following(p.J) + N.inverse() * p.A.transpose() * p.J).norm(), 1e-12);
    EXPECT_LT((projection.deviations() - N.inverse().diagonal().cwiseSqrt()).norm(), 1e-12);
  }
}

TEST(NuisanceProjection, LeavesTheCovarianceOfTheVariablesInTheProblemOfAllUnknowns) {
  const Projected p(11);
  const NuisanceProjection projection(p.A, p.sigma);
  const Eigen::MatrixXd following = projection.following(p.J);
  const Eigen::MatrixXd projected = p.J + p.A * following;
  // rows of priors, where there is one
  const Eigen::MatrixXd prior = p.S.cwiseSqrt() * following;
  const Eigen::MatrixXd own =
      (projected.transpose() * projected + prior.transpose() * prior).inverse();
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(43, 5);
  all.topLeftCorner(40, 2) = p.J;
  all.topRightCorner(40, 3) = p.A;
  all.bottomRightCorner(3, 3) = p.S.cwiseSqrt();
  const Eigen::MatrixXd covariance = (all.transpose() * all).inverse();
  EXPECT_LT((own - covariance.topLeftCorner(2, 2)).norm(), 1e-12);
}

TEST(NuisanceProjection, ANumberThatActsLikeAnEarlierOneStaysAtZero) {
  Projected p(3);
  p.A.col(1) = -2.0 * p.A.col(0);
  p.sigma[0] = INFINITY;
  const NuisanceProjection projection(p.A, p.sigma);
  EXPECT_TRUE(projection.determines(0));
  EXPECT_FALSE(projection.determines(1));
  EXPECT_TRUE(projection.determines(2));
  EXPECT_EQ(projection.step(p.r, Eigen::Vector3d::Zero())[1], 0.0);
  EXPECT_EQ(projection.deviations()[1], 0.0);
}

}  // namespace
}  // namespace latsch::correlation
