// SPDX-License-Identifier: Apache-2.0
#include "evaluation/schedule/group_commit.h"

#include <gtest/gtest.h>

#include <semaphore>

namespace latsch {
namespace {

Trial trial(double x) { return {.point = {{x}}, .outcome = {.result = Channels{}}}; }

/// A store in which every commit waits until it is released.
class SlowStore : public TrialStore {
 public:
  void append(std::span<const Trial> trials) override {
    begun_.release();
    may_end_.acquire();
    if (full_) throw JournalError("the disk is full");
    groups_.push_back(std::ssize(trials));
  }
  void for_each(const std::function<void(const Trial&)>&) const override {}

  std::counting_semaphore<> begun_{0};
  std::counting_semaphore<> may_end_{0};
  bool full_ = false;
  std::vector<long> groups_;
};

TEST(GroupCommit, WhatFinishesDuringACommitIsTheNextGroup) {
  SlowStore store;
  GroupCommit commits(&store, true);
  commits.add({trial(1)});
  store.begun_.acquire();
  commits.add({trial(2)});
  commits.add({trial(3), trial(4)});
  EXPECT_TRUE(commits.take().empty());  // nothing is on the disk yet
  store.may_end_.release();
  commits.wait();
  EXPECT_EQ(commits.take().size(), 1u);
  store.may_end_.release();
  commits.wait();
  const std::vector<Trial> rest = commits.take();
  ASSERT_EQ(rest.size(), 3u);
  EXPECT_EQ(rest[0].point, trial(2).point);
  EXPECT_EQ(rest[2].point, trial(4).point);
  EXPECT_EQ(store.groups_, (std::vector<long>{1, 3}));
}

TEST(GroupCommit, WhatTheStoreRefusesIsThrownAndNeverGivenBack) {
  SlowStore store;
  store.full_ = true;
  store.may_end_.release(2);
  GroupCommit commits(&store, true);
  commits.add({trial(1)});
  commits.wait();
  EXPECT_THROW(commits.take(), JournalError);
  GroupCommit foreground(&store, false);
  EXPECT_THROW(foreground.add({trial(2)}), JournalError);
}

TEST(GroupCommit, CommitsWhatItHasWhenItEnds) {
  SlowStore store;
  store.may_end_.release(10);
  {
    GroupCommit commits(&store, true);
    for (int i = 0; i < 5; ++i) commits.add({trial(i)});
  }
  long kept = 0;
  for (const long group : store.groups_) kept += group;
  EXPECT_EQ(kept, 5);
}

TEST(GroupCommit, WithoutAStoreNothingWaits) {
  GroupCommit commits(nullptr, true);
  commits.add({trial(1)});
  commits.wait();
  EXPECT_EQ(commits.take().size(), 1u);
  commits.wait();
}

}  // namespace
}  // namespace latsch
