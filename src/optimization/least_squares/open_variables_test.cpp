// SPDX-License-Identifier: Apache-2.0
#include "optimization/least_squares/open_variables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace latsch {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

DesignSpace two_variables() {
  return DesignSpace(
      {{.name = "a", .lower = 0.0, .upper = 10.0, .initial = 5.0},
       {.name = "b", .lower = 1.0, .upper = 100.0, .initial = 10.0, .scale = Scale::logarithmic}});
}

PointSlopes exact(const Eigen::MatrixXd& J) {
  return {J, Eigen::MatrixXd::Zero(J.cols(), J.cols())};
}

const Eigen::VectorXd kMiddle = Eigen::VectorXd::Constant(2, 0.5);

TEST(OpenVariables, AreThoseWhoseEffectIsAsSmallAsTheResiduals) {
  // The value of a is 5. A move of 0.025 of its range, 5 % of the value, changes the residuals by
  // 0.025 times its slope.
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3, 2);
  J(0, 0) = 1.0;
  J(1, 1) = 1.0;
  EXPECT_THAT(open_variables(two_variables(), kMiddle, exact(J), 0.024), ElementsAre("b"));
  EXPECT_THAT(open_variables(two_variables(), kMiddle, exact(J), 0.026), ElementsAre("a", "b"));
  // The logarithm of b spans ln 100, so 5 % of b is 0.05 / ln 100 of its range.
  EXPECT_THAT(open_variables(two_variables(), kMiddle, exact(J), 0.9 * 0.05 / std::log(100.0)),
              IsEmpty());
  EXPECT_THAT(open_variables(two_variables(), kMiddle, exact(J), 1.1 * 0.05 / std::log(100.0)),
              ElementsAre("b"));
}

TEST(OpenVariables, AreBothOfAPairThatOnlyItsSumDetermines) {
  // The singular values are sqrt(2) and 1e-6 / sqrt(2): along a - b nothing is known.
  Eigen::MatrixXd J(2, 2);
  J << 1.0, 1.0, 0.0, 1e-6;
  EXPECT_THAT(open_variables(two_variables(), kMiddle, exact(J), 1e-6), ElementsAre("a", "b"));
  EXPECT_THAT(open_variables(two_variables(), kMiddle, exact(J), 1e-9), IsEmpty());
}

TEST(OpenVariables, AreThoseWhoseSlopesAreNoLargerThanTheirErrors) {
  PointSlopes slopes = exact(Eigen::MatrixXd::Identity(3, 2));
  slopes.J(1, 1) = 1e-6;
  EXPECT_THAT(open_variables(two_variables(), kMiddle, slopes, 1e-12), IsEmpty());
  slopes.covariance(1, 1) = 1e-11;
  EXPECT_THAT(open_variables(two_variables(), kMiddle, slopes, 1e-12), ElementsAre("b"));
}

TEST(OpenVariables, AreThoseWithoutEffectHoweverSmallTheResiduals) {
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3, 2);
  J(0, 0) = 1.0;
  EXPECT_THAT(open_variables(two_variables(), kMiddle, exact(J), 1e-12), ElementsAre("b"));
}

}  // namespace
}  // namespace latsch
