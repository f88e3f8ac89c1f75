// SPDX-License-Identifier: Apache-2.0
#include "numerics/dense/least_squares.h"

#include <gtest/gtest.h>

#include <cmath>

namespace latsch::numerics {
namespace {

// Rosenbrock's valley is a sum of squares, (1 - x)^2 + 100 (y - x^2)^2, with its minimum 0 at (1,
// 1).
TEST(LeastSquares, FindsTheEndOfRosenbrocksValley) {
  const auto found = least_squares(
      [](const Eigen::VectorXd& x) -> Eigen::VectorXd {
        return Eigen::Vector2d(1.0 - x[0], 10.0 * (x[1] - x[0] * x[0]));
      },
      Eigen::Vector2d(-1.2, 1.0));
  EXPECT_TRUE(found.converged);
  EXPECT_NEAR(found.x[0], 1.0, 1e-9);
  EXPECT_NEAR(found.x[1], 1.0, 1e-9);
}

// The line through (0,1), (1,3), (2,4), (3,4) has slope 1, offset 3/2, |r|^2 = 1. Its covariance by
// linear theory is s^2 (X^T X)^-1 with s^2 = 1/2, X^T X = [4 6; 6 14].
TEST(LeastSquares, CovarianceOfALineIsThatOfTheLinearTheory) {
  const Eigen::Vector4d t(0, 1, 2, 3), y(1, 3, 4, 4);
  const auto found = least_squares(
      [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
        return (y - Eigen::Vector4d::Constant(x[0]) - x[1] * t).eval();
      },
      Eigen::Vector2d::Zero());
  EXPECT_NEAR(found.x[0], 1.5, 1e-10);
  EXPECT_NEAR(found.x[1], 1.0, 1e-10);
  EXPECT_NEAR(found.sum, 1.0, 1e-10);
  EXPECT_NEAR(found.covariance(0, 0), 0.5 * 14.0 / 20.0, 1e-7);
  EXPECT_NEAR(found.covariance(1, 1), 0.5 * 4.0 / 20.0, 1e-7);
  EXPECT_NEAR(found.covariance(0, 1), -0.5 * 6.0 / 20.0, 1e-7);
}

TEST(LeastSquares, AnUnknownThatDoesNothingIsNotDetermined) {
  const auto found = least_squares(
      [](const Eigen::VectorXd& x) -> Eigen::VectorXd {
        return Eigen::Vector3d(x[0] - 1.0, x[0] - 2.0, 2.0 * x[0] - 3.0);
      },
      Eigen::Vector2d(0.0, 1.0));
  EXPECT_NEAR(found.x[0], 1.5, 1e-9);
  EXPECT_TRUE(std::isinf(found.covariance(1, 1)));
}

}  // namespace
}  // namespace latsch::numerics
