// SPDX-License-Identifier: Apache-2.0
#include "correlation/observable/mac.h"

#include <gtest/gtest.h>

#include <cmath>

namespace latsch::correlation {
namespace {

constexpr double kRoundOfShapes = 1e-14;

TEST(Mac, IsOneForTheSameShapeAtAnyScaleAndSign) {
  const Eigen::Vector3d phi(1.0, -2.0, 0.5);
  EXPECT_NEAR(mac(phi, -3.7 * phi), 1.0, kRoundOfShapes);
}

TEST(Mac, IsTheSquaredCosineOfTheAngle) {
  const double angle = 0.4;
  const Eigen::Vector2d phi(1.0, 0.0), psi(2.0 * std::cos(angle), 2.0 * std::sin(angle));
  EXPECT_NEAR(mac(phi, psi), std::cos(angle) * std::cos(angle), kRoundOfShapes);
}

TEST(Mac, OfAShapeThatIsZeroEverywhereIsZero) {
  EXPECT_EQ(mac(Eigen::Vector2d(1.0, 0.0), Eigen::Vector2d::Zero()), 0.0);
}

TEST(SubspaceMac, DoesNotSeeTheArbitraryPhaseOfADegeneratePair) {
  Eigen::MatrixXd A(3, 2), B(3, 2);
  A << 1, 0, 0, 1, 0, 0;
  B << std::cos(0.3), -std::sin(0.3), std::sin(0.3), std::cos(0.3), 0, 0;
  EXPECT_NEAR(mac(A, B), 1.0, kRoundOfShapes);
  // the MAC is cos^2 0.3 if the two modes of a pair are compared one by one, which looks like a
  // mismatch
  EXPECT_LT(mac(A.col(0), B.col(0)), 0.92);
}

TEST(SubspaceMac, IsTheMeanSquaredCosineOfThePrincipalAngles) {
  Eigen::MatrixXd A(3, 2), B(3, 2);  // planes that share e1 and are inclined by 0.5 rad about it
  A << 1, 0, 0, 1, 0, 0;
  B << 1, 0, 0, std::cos(0.5), 0, std::sin(0.5);
  EXPECT_NEAR(mac(A, B), 0.5 * (1.0 + std::cos(0.5) * std::cos(0.5)), kRoundOfShapes);
}

TEST(SubspaceMac, OfAVectorInsideAPlaneIsOne) {
  Eigen::MatrixXd plane(3, 2);
  plane << 1, 0, 0, 1, 0, 0;
  EXPECT_NEAR(mac(Eigen::Vector3d(0.6, 0.8, 0.0), plane), 1.0, kRoundOfShapes);
}

}  // namespace
}  // namespace latsch::correlation
