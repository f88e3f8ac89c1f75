// SPDX-License-Identifier: Apache-2.0
#include "optimization/least_squares/step_in_box.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

namespace latsch {
namespace {

// The function 1/2 p'H p + g'p. Its minimum without bounds is (3, -1); if p0 is held at 1, the
// minimum is at p1 = -(g1 + H10) / H11.
struct Quadratic {
  Eigen::Matrix2d H{{2, 1}, {1, 2}};
  Eigen::Vector2d g{-5, -1};

  Eigen::VectorXd operator()(const Eigen::VectorXd& p, const std::vector<int>& free) const {
    const Eigen::MatrixXd A = H(free, free);
    return A.inverse() * -(g + H * p)(free);
  }
};

TEST(StepInBox, IsTheFreeStepWhereThatIsInside) {
  const auto p = step_in_box(Eigen::Vector2d(-9, -9), Eigen::Vector2d(9, 9), {0, 1}, Quadratic());
  EXPECT_NEAR(p[0], 3.0, 1e-14);
  EXPECT_NEAR(p[1], -1.0, 1e-14);
}

TEST(StepInBox, SeeksTheOthersAgainWhereAVariableIsHeldAtItsFace) {
  const auto p = step_in_box(Eigen::Vector2d(-9, -9), Eigen::Vector2d(1, 9), {0, 1}, Quadratic());
  EXPECT_EQ(p[0], 1.0);
  EXPECT_NEAR(p[1], 0.0, 1e-14);
}

TEST(StepInBox, EndsInACornerAndLeavesHeldVariablesAlone) {
  EXPECT_EQ(step_in_box(Eigen::Vector2d(-9, -9), Eigen::Vector2d(1, -2), {0, 1}, Quadratic()),
            Eigen::VectorXd(Eigen::Vector2d(1, -2)));
  const auto p = step_in_box(Eigen::Vector2d(-9, -9), Eigen::Vector2d(9, 9), {1}, Quadratic());
  EXPECT_EQ(p[0], 0.0);
  EXPECT_NEAR(p[1], 0.5, 1e-14);
}

}  // namespace
}  // namespace latsch
