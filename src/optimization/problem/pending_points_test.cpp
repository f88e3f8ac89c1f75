// SPDX-License-Identifier: Apache-2.0
#include "optimization/problem/pending_points.h"

#include <gtest/gtest.h>

namespace latsch {
namespace {

struct Labeled {
  DesignPoint point;
  int label;
};

TEST(PendingPoints, GivesAPointOnceAndKeepsTheOrderOfTheOthers) {
  PendingPoints<Labeled> pending{{{{1.0}}, 1}, {{{2.0}}, 2}, {{{3.0}}, 3}};
  const auto taken = pending.take({{2.0}});
  ASSERT_TRUE(taken);
  EXPECT_EQ(taken->label, 2);
  EXPECT_FALSE(pending.contains({{2.0}}));
  EXPECT_FALSE(pending.take({{2.0}}));
  ASSERT_EQ(pending.size(), 2);
  EXPECT_EQ(pending.front().label, 1);
  EXPECT_EQ(pending.back().label, 3);
}

// A method may wait for the same point twice, for different reasons. The older entry is returned
// first.
TEST(PendingPoints, OfTwoAtOnePointTheFirstIsTaken) {
  PendingPoints<Labeled> pending{{{{1.0}}, 1}, {{{1.0}}, 2}};
  EXPECT_EQ(pending.take({{1.0}})->label, 1);
  EXPECT_EQ(pending.take({{1.0}})->label, 2);
  EXPECT_TRUE(pending.empty());
}

TEST(PendingPoints, DoNotGiveAForeignPoint) {
  PendingPoints<Labeled> pending{{{{1.0}}, 1}};
  EXPECT_FALSE(pending.take({{1.5}}));
  EXPECT_EQ(pending.size(), 1);
}

TEST(Plan, NamesNoPointTwiceAndNoMoreThanAskedFor) {
  Plan plan(2);
  EXPECT_TRUE(plan.is_empty());
  plan.add(PendingPoints<Labeled>{{{{1.0}}, 1}, {{{1.0}}, 2}, {{{2.0}}, 3}, {{{3.0}}, 4}});
  EXPECT_TRUE(plan.is_full());
  EXPECT_EQ(plan.points(), (std::vector<DesignPoint>{{{1.0}}, {{2.0}}}));
}

}  // namespace
}  // namespace latsch
