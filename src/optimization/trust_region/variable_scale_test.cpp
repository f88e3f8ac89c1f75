// SPDX-License-Identifier: Apache-2.0
#include "optimization/trust_region/variable_scale.h"

#include <gtest/gtest.h>

#include <cmath>

namespace latsch {
namespace {

TEST(VariableScale, IsTheGeometricMeanOfTheCubeAndOfMoresScale) {
  VariableScale scale(Eigen::VectorXd::Ones(2));
  EXPECT_EQ(scale.widths(), Eigen::Vector2d(1.0, 1.0));
  // For this Jacobian, Moré's scale is 1/4 and 4.
  scale.learn(Eigen::Vector2d(4.0, 0.25).asDiagonal());
  EXPECT_NEAR(scale.widths()[0], 0.5, 1e-15);
  EXPECT_NEAR(scale.widths()[1], 2.0, 1e-15);
  EXPECT_NEAR(scale.length(Eigen::Vector2d(1.0, -8.0)), 4.0, 1e-14);
}

TEST(VariableScale, DoesNotDependOnTheUnitOfTheResiduals) {
  VariableScale one(Eigen::VectorXd::Ones(2)), other(Eigen::VectorXd::Ones(2));
  const Eigen::Matrix2d J{{1.0, 3.0}, {-2.0, 5.0}};
  one.learn(J);
  other.learn(1e6 * J);
  EXPECT_NEAR((one.widths() - other.widths()).norm(), 0.0, 1e-14);
}

TEST(VariableScale, DoesNotDependOnTheRangesIfTheBaseWidthsTakeThemOut) {
  // The second variable is stated over a range a thousand times as wide, so that its unit is one.
  VariableScale narrow(Eigen::Vector2d(1.0, 1.0)), wide(Eigen::Vector2d(1.0, 1e-3));
  const Eigen::Matrix2d J{{1.0, 3.0}, {-2.0, 5.0}};
  narrow.learn(J);
  wide.learn(J * Eigen::Vector2d(1.0, 1e3).asDiagonal());
  EXPECT_NEAR(wide.widths()[0], narrow.widths()[0], 1e-12);
  EXPECT_NEAR(1e3 * wide.widths()[1], narrow.widths()[1], 1e-12);
}

TEST(VariableScale, WidensItsBaseAndNeverNarrowsIt) {
  VariableScale scale(Eigen::Vector2d(0.1, 0.5));
  scale.widen(Eigen::Vector2d(0.2, 0.3));
  EXPECT_EQ(scale.widths(), Eigen::Vector2d(0.2, 0.5));
}

TEST(VariableScale, RemembersTheLargestEffectAndBoundsWhatHasNone) {
  VariableScale scale(Eigen::VectorXd::Ones(2));
  scale.learn(Eigen::Vector2d(1.0, 0.0).asDiagonal());
  EXPECT_NEAR(scale.widths()[1] / scale.widths()[0], std::sqrt(1e3), 1e-10);
  scale.learn(Eigen::Vector2d(0.0, 1.0).asDiagonal());
  EXPECT_NEAR(scale.widths()[1], scale.widths()[0], 1e-14);
  scale.learn(Eigen::Vector2d(std::nan(""), 1.0).asDiagonal());
  EXPECT_NEAR(scale.widths()[1], scale.widths()[0], 1e-14);
}

}  // namespace
}  // namespace latsch
