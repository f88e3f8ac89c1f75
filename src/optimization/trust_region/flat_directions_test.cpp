// SPDX-License-Identifier: Apache-2.0
#include "optimization/trust_region/flat_directions.h"

#include <gtest/gtest.h>

namespace latsch {
namespace {

TEST(FlatDirections, AreThoseTheResidualsDoNotFeel) {
  // For r = (a + b, 3 c) only a - b has no effect.
  Eigen::MatrixXd J(2, 3);
  J << 1, 1, 0, 0, 0, 3;
  const Eigen::MatrixXd flat = flat_directions(J, 0.1, 1.0);
  ASSERT_EQ(flat.cols(), 1);
  EXPECT_NEAR(std::abs(flat(0, 0) - flat(1, 0)), std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(flat(2, 0), 0.0, 1e-12);
}

TEST(FlatDirections, AreNoneWhereEveryVariableIsFelt) {
  Eigen::MatrixXd J = Eigen::MatrixXd::Identity(3, 2);
  J(1, 1) = 1e-4;  // a weak effect, but above a millionth of the residuals
  EXPECT_EQ(flat_directions(J, 0.1, 1.0).cols(), 0);
  // A weak effect is none beside large residuals.
  EXPECT_EQ(flat_directions(J, 0.1, 1e3).cols(), 1);
}

TEST(FlatDirections, ResidualsDifferByMoreThanAMillionthOrAreTheSame) {
  const Eigen::VectorXd r = Eigen::VectorXd::Constant(4, 2.0);
  EXPECT_TRUE(is_same(r * (1.0 + 1e-7), r));
  EXPECT_FALSE(is_same(r * (1.0 + 1e-5), r));
}

}  // namespace
}  // namespace latsch
