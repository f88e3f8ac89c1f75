// SPDX-License-Identifier: Apache-2.0
#include "optimization/trust_region/natural_frame.h"

#include <gtest/gtest.h>

#include <limits>

namespace latsch {
namespace {

const Eigen::MatrixXd kJ{{3.0, 1.0}, {0.0, 0.5}, {1.0, 1.0}};

NaturalFrame frame_at(const Eigen::Vector2d& u, double r) {
  return natural_frame(
      kJ, r, u, Eigen::Vector2d(1.0, 2.0), Eigen::Matrix2d::Identity(), {1e-6, 0.2});
}

TEST(NaturalFrame, ResidualsChangeByAsMuchAsTheyAreAlongEveryAxis) {
  const NaturalFrame frame = frame_at({0.5, 0.5}, 0.01);
  ASSERT_EQ(frame.axes(), 2);
  for (int k = 0; k < 2; ++k) EXPECT_NEAR((kJ * frame.T.col(k)).norm(), 0.01, 1e-12);
  EXPECT_LT((frame.inverse * frame.T - Eigen::Matrix2d::Identity()).norm(), 1e-9);
}

TEST(NaturalFrame, LengthsEndAtAShareOfTheRange) {
  const NaturalFrame frame = frame_at({0.5, 0.5}, 100.0);
  for (int k = 0; k < 2; ++k) EXPECT_NEAR(frame.T.col(k).lpNorm<Eigen::Infinity>(), 0.2, 1e-12);
}

TEST(NaturalFrame, AVariableAtABoundHasAnAxisOfItsOwn) {
  const NaturalFrame frame = frame_at({0.0, 0.5}, 0.01);
  ASSERT_EQ(frame.axes(), 2);
  EXPECT_EQ(frame.T(0, 0), 0.0);
  EXPECT_EQ(frame.T(1, 1), 0.0);
}

// If a decomposition met NaN, it would leave memory uninitialized, and the search would differ from
// run to run.
TEST(NaturalFrame, SlopesThatAreNoNumbersCountAsUnknown) {
  const auto frame_of = [](const Eigen::Matrix2d& J) {
    return natural_frame(J,
                         0.01,
                         Eigen::Vector2d(0.5, 0.5),
                         Eigen::Vector2d(1.0, 2.0),
                         Eigen::Matrix2d::Identity(),
                         {1e-6, 0.2});
  };
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(frame_of(Eigen::Matrix2d{{3.0, none}, {0.0, 0.5}}).T,
            frame_of(Eigen::Matrix2d::Zero()).T);
}

}  // namespace
}  // namespace latsch
