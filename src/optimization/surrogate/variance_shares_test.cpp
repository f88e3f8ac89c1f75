// SPDX-License-Identifier: Apache-2.0
#include "optimization/surrogate/variance_shares.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "optimization/design/sobol.h"
#include "optimization/surrogate/polynomial_chaos.h"
#include "optimization/surrogate/sensitivity_functions_testing.h"

namespace latsch {
namespace {

Eigen::MatrixXd spread_points(int n, int count, int seed = 3) {
  std::vector<DesignVariable> variables;
  for (int i = 0; i < n; ++i) variables.push_back({.name = fmt::format("u{}", i)});
  const auto plan = sobol(DesignSpace(variables), count, seed);
  Eigen::MatrixXd points(count, n);
  for (int k = 0; k < count; ++k)
    for (int i = 0; i < n; ++i) points(k, i) = plan.points[k].values[i];
  return points;
}

Eigen::VectorXd values_at(const Eigen::MatrixXd& points, const ResponseOfCube& y) {
  Eigen::VectorXd values(points.rows());
  for (Eigen::Index k = 0; k < values.size(); ++k) values[k] = y(points.row(k).transpose());
  return values;
}

// The orthonormal Legendre polynomials over 0 .. 1 are sqrt(3) (2 u - 1) and
// sqrt(5) (6 u^2 - 6 u + 1), so that 2 u = 1 + 1 / sqrt(3) P_1 and u^2 = 1/3 + P_1 / (2 sqrt(3)) +
// P_2 / (6 sqrt(5)).
TEST(PolynomialChaos, APolynomialHasItsCoefficients) {
  const Eigen::MatrixXd points = spread_points(3, 60);
  const PolynomialChaos chaos(points, values_at(points, [](const Eigen::VectorXd& u) {
                                return 4.0 + 2.0 * u[0] + 3.0 * u[1] * u[1];
                              }));
  for (const auto& term : chaos.terms()) {
    double expected = 0.0;
    if (term.degrees == std::vector{0, 0, 0}) expected = 6.0;
    if (term.degrees == std::vector{1, 0, 0}) expected = 1.0 / std::sqrt(3.0);
    if (term.degrees == std::vector{0, 1, 0}) expected = 1.5 / std::sqrt(3.0);
    if (term.degrees == std::vector{0, 2, 0}) expected = 0.5 / std::sqrt(5.0);
    EXPECT_NEAR(term.coefficient, expected, 1e-12);
  }
  EXPECT_EQ(chaos.terms().size(), 4u);
  EXPECT_NEAR(chaos.variance(), 1.0 / 3.0 + 0.75 + 0.05, 1e-12);
  EXPECT_NEAR(chaos.value(Eigen::Vector3d(0.3, 0.9, 0.1)), 4.0 + 0.6 + 3.0 * 0.81, 1e-12);
}

TEST(VarianceShares, IshigamisFunctionHasItsClosedForm) {
  const Eigen::MatrixXd points = spread_points(3, 80);
  const VarianceShares found = variance_shares(points, values_at(points, ishigami));
  const ClosedShares expected = shares_of_ishigami();
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(found.first[i].value, expected.first[i], 0.003);
    EXPECT_NEAR(found.total[i].value, expected.total[i], 0.003);
    EXPECT_LE(found.first[i].lower, expected.first[i]);
    EXPECT_GE(found.first[i].upper, expected.first[i]);
  }
  EXPECT_GT(found.explained, 0.99);
}

TEST(VarianceShares, NoiseIsNotExplained) {
  const Eigen::MatrixXd points = spread_points(4, 60);
  RandomStream random(7, 0);
  const VarianceShares found =
      variance_shares(points, values_at(points, [&](const auto&) { return random.normal(); }));
  EXPECT_LT(found.explained, 0.3);
  EXPECT_FALSE(found.is_trusted());
  for (const VarianceShare& share : found.total) EXPECT_GT(share.upper - share.lower, 0.5);
}

TEST(VarianceShares, AResponseThatDoesNotVaryHasNone) {
  const Eigen::MatrixXd points = spread_points(2, 20);
  EXPECT_TRUE(
      variance_shares(points, values_at(points, [](const auto&) { return 3e5; })).is_constant());
}

TEST(VarianceShares, TheSamePointsGiveTheSameBits) {
  const Eigen::MatrixXd points = spread_points(8, 60);
  const Eigen::VectorXd values = values_at(points, sobols_g);
  const VarianceShares one = variance_shares(points, values),
                       other = variance_shares(points, values);
  for (int i = 0; i < 8; ++i) EXPECT_EQ(one.total[i].value, other.total[i].value);
}

}  // namespace
}  // namespace latsch
