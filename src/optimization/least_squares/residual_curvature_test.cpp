// SPDX-License-Identifier: Apache-2.0
#include "optimization/least_squares/residual_curvature.h"

#include <gtest/gtest.h>

#include <cmath>

namespace latsch {
namespace {

/// The residuals are r = (x^3 - 2 x^2 + y, 3 x^2 + x y).
Slopes cubic_at(double x, double y) {
  return {Eigen::Vector2d(x, y),
          Eigen::Vector2d(x * x * x - 2 * x * x + y, 3 * x * x + x * y),
          Eigen::Matrix2d{{3 * x * x - 4 * x, 1.0}, {6 * x + y, x}}};
}

// Along x the curvature is r'' = (6 x - 4, 6), for steps of any length and sign and from either
// point.
TEST(ResidualCurvature, IsExactAlongTheWayForCubicResiduals) {
  const double x = 0.7;
  for (const double other : {0.2, 1.9}) {
    for (const double p : {0.3, -1.5}) {
      const Eigen::VectorXd c =
          residual_curvature(cubic_at(x, 0.4), cubic_at(other, 0.4), Eigen::Vector2d(p, 0.0));
      EXPECT_NEAR(c[0], 0.5 * (6 * x - 4) * p * p, 1e-12);
      EXPECT_NEAR(c[1], 0.5 * 6 * p * p, 1e-12);
    }
  }
}

// For r = x^2 + 3 x y + 5 y^2 and s along x, the result is 1/2 r''[p, p] without the term 5 q^2 of
// the perpendicular part q.
TEST(ResidualCurvature, LacksOnlyTheTermAcrossForQuadraticResiduals) {
  const auto at = [](double x, double y) {
    return Slopes{Eigen::Vector2d(x, y),
                  Eigen::VectorXd::Constant(1, x * x + 3 * x * y + 5 * y * y),
                  Eigen::RowVector2d(2 * x + 3 * y, 3 * x + 10 * y)};
  };
  const double px = 0.6, py = -0.2;
  const Eigen::VectorXd c = residual_curvature(at(0.5, 0.1), at(0.1, 0.1), Eigen::Vector2d(px, py));
  EXPECT_NEAR(c[0], px * px + 3 * px * py, 1e-13);
}

// For r = exp(x) the second derivative of the cubic through two points at a distance h has an error
// of the fourth derivative times h^2 / 12.
TEST(ResidualCurvature, ConvergesWithTheSquareOfTheDistance) {
  const auto at = [](double x) {
    const Eigen::VectorXd value = Eigen::VectorXd::Constant(1, std::exp(x));
    return Slopes{Eigen::VectorXd::Constant(1, x), value, value};
  };
  const auto error = [&](double h) {
    const Eigen::VectorXd p = Eigen::VectorXd::Constant(1, 1.0);
    return std::abs(residual_curvature(at(0.0), at(-h), p)[0] - 0.5);
  };
  EXPECT_NEAR(error(0.02) / error(0.01), 4.0, 0.1);
  EXPECT_NEAR(error(0.01), 0.5 * 0.01 * 0.01 / 12.0, 1e-7);
}

}  // namespace
}  // namespace latsch
