// SPDX-License-Identifier: Apache-2.0
#include "optimization/region/failure_edges.h"

#include <gtest/gtest.h>

#include <cstdint>

#include "base/random.h"

namespace latsch {
namespace {

using Eigen::Vector2d;

TEST(FailureEdges, LieMidwayAndFaceTheFailures) {
  // Failures are at x = 3, successes up to x = 1, so x = 2 lies in the middle of the widest gap.
  const auto edges = failure_edges({Vector2d(3, 0), Vector2d(3, 2), Vector2d(3, 1)},
                                   {Vector2d(1, 1), Vector2d(-1, 0)});
  ASSERT_EQ(edges.size(), 1u);
  EXPECT_NEAR(edges[0].a[0], 1.0, 1e-6);
  EXPECT_NEAR(edges[0].b, 2.0, 1e-4);
}

TEST(FailureEdges, AreTwoWhereBothSidesFail) {
  const auto edges = failure_edges({Vector2d(1, 0),
                                    Vector2d(-1, 0.1),
                                    Vector2d(1, 0.5),
                                    Vector2d(-1, 0.5),
                                    Vector2d(1, 0.2),
                                    Vector2d(-1, 0.3)},
                                   {Vector2d(0, 1)});
  ASSERT_EQ(edges.size(), 2u);
  EXPECT_LT(edges[0].a[0] * edges[1].a[0], 0.0);
}

TEST(FailureEdges, AreNotMadeOfOneFailureNorOfSomeAmongSuccesses) {
  EXPECT_TRUE(failure_edges({Vector2d(1, 0)}, {}).empty());
  EXPECT_TRUE(failure_edges({Vector2d(1, 0), Vector2d(1, 0.2)}, {}).empty());
  EXPECT_TRUE(failure_edges({Vector2d(1, 0), Vector2d(1, 0.2)},
                            {Vector2d(2, 0), Vector2d(1, 1), Vector2d(0, -1), Vector2d(1.2, -1)})
                  .empty());
}

TEST(FailureEdges, BearAPointThatFailedAgainAndAgain) {
  const auto edges =
      failure_edges(std::vector<Eigen::VectorXd>(3, Vector2d(2, 0)), {Vector2d(-1, 0)});
  ASSERT_EQ(edges.size(), 1u);
  EXPECT_NEAR(edges[0].b, 1.0, 1e-4);
}

/// Returns in how many of 100 random sets an edge is found; the failures lie at random positions
/// among the successes.
int sets_with_edge(int n, int failures, int successes) {
  int found = 0;
  for (std::uint64_t set = 0; set < 100; ++set) {
    RandomStream numbers(7, set);
    std::vector<Eigen::VectorXd> points[2];
    for (int k = 0; k < failures + successes; ++k) {
      Eigen::VectorXd x(n);
      for (double& value : x) value = numbers.normal();
      points[k < failures ? 0 : 1].push_back(x);
    }
    found += failure_edges(points[0], points[1]).empty() ? 0 : 1;
  }
  return found;
}

// Some plane separates nearly any few points in many variables. Without a cross-check, an edge
// would be found in all of these sets.
TEST(FailureEdges, AreSeldomSeenInFailuresByLot) {
  EXPECT_LE(sets_with_edge(3, 4, 16), 20);
  EXPECT_LE(sets_with_edge(8, 4, 16), 20);
  EXPECT_LE(sets_with_edge(11, 6, 40), 20);
}

}  // namespace
}  // namespace latsch
