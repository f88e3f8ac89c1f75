// SPDX-License-Identifier: Apache-2.0
#include "optimization/failure_edges.h"

#include <gtest/gtest.h>

namespace latsch {
namespace {

using Eigen::Vector2d;

TEST(FailureEdges, LieMidwayAndFaceTheFailures) {
  // Failures at x = 3, successes up to x = 1: the widest gap is parted by x = 2.
  const auto edges =
      failure_edges({Vector2d(3, 0), Vector2d(3, 2)}, {Vector2d(1, 1), Vector2d(-1, 0)});
  ASSERT_EQ(edges.size(), 1u);
  EXPECT_NEAR(edges[0].a[0], 1.0, 1e-6);
  EXPECT_NEAR(edges[0].b, 2.0, 1e-4);
}

TEST(FailureEdges, AreTwoWhereBothSidesFail) {
  const auto edges = failure_edges(
      {Vector2d(1, 0), Vector2d(-1, 0.1), Vector2d(1, 0.5), Vector2d(-1, 0.5)}, {Vector2d(0, 1)});
  ASSERT_EQ(edges.size(), 2u);
  EXPECT_LT(edges[0].a[0] * edges[1].a[0], 0.0);
}

TEST(FailureEdges, AreNotMadeOfOneFailureNorOfSomeAmongSuccesses) {
  EXPECT_TRUE(failure_edges({Vector2d(1, 0)}, {}).empty());
  EXPECT_TRUE(failure_edges({Vector2d(1, 0), Vector2d(1, 0.2)},
                            {Vector2d(2, 0), Vector2d(1, 1), Vector2d(0, -1), Vector2d(1.2, -1)})
                  .empty());
}

}  // namespace
}  // namespace latsch
