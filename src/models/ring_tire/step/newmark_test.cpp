// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/step/newmark.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "models/ring_tire/belt/belt_curve.h"

namespace latsch::ring_tire {
namespace {

class Newmark : public testing::TestWithParam<int> {
 protected:
  NodeValues values() const { return NodeValues::Random(4, GetParam()); }
};

TEST_P(Newmark, WeighsAtKnotsAndBack) {
  const Eigen::Vector4d m(1.0, 2.0, 3.0, 0.5);
  const NodeValues a = values(), expected = m.asDiagonal() * at_knots(at_knots(a));
  NodeValues force;
  at_knots_and_back(m, a, force);
  EXPECT_LT((force - expected).cwiseAbs().maxCoeff(), 1e-15);
}

TEST_P(Newmark, FollowsThePlaces) {
  const StepRule rule{.step = 1e-3, .velocity = 2100.0, .acceleration = 3.9e6};
  const NodeValues q1 = values(), predicted = values(), v = values(), a = values();
  NodeValues v1, a1;
  follow(rule, q1, predicted, v, a, v1, a1);
  const NodeValues way = q1 - predicted;
  EXPECT_LT((v1 - v - rule.velocity * way).norm(), 1e-15 * v1.norm());
  EXPECT_LT((a1 - a - rule.acceleration * way).norm(), 1e-15 * a1.norm());
}

TEST_P(Newmark, LeavesWhatIsNotBalanced) {
  const NodeValues f1 = values(), f0 = values(), inertia = values();
  const NodeValues expected = 0.95 * f1 + 0.05 * f0 - inertia;
  NodeValues residual;
  EXPECT_NEAR(
      find_residual(0.05, f1, f0, inertia, residual), expected.cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_LT((residual - expected).cwiseAbs().maxCoeff(), 1e-15);
}

TEST_P(Newmark, SeesANumberThatIsNone) {
  const NodeValues good = values();
  for (const double none :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    for (const Eigen::Index at : {Eigen::Index{0}, good.size() / 2, good.size() - 1}) {
      NodeValues bad = good, residual;
      bad.data()[at] = none;
      EXPECT_FALSE(std::isfinite(find_residual(0.05, bad, good, good, residual))) << at;
    }
}

INSTANTIATE_TEST_SUITE_P(Nodes, Newmark, testing::Values(8, 13, 48));

}  // namespace
}  // namespace latsch::ring_tire
