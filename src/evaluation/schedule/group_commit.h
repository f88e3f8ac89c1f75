// SPDX-License-Identifier: Apache-2.0
// Writes finished trials to their store while workers continue.
//
// A commit waits milliseconds for the disk. Trials that finish during this time form the next
// commit, so that each group waits for the disk once and workers never wait. Trials returned by
// take() are on the disk; they must not be passed to an optimizer earlier.
#pragma once

#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "evaluation/journal/trial_store.h"

namespace latsch {

class GroupCommit {
 public:
  /// If `in_background` is false, add() commits before it returns; this is meant for simulations
  /// with a virtual clock. If `store` is nullptr, nothing is stored.
  GroupCommit(TrialStore* store, bool in_background);
  /// Commits the trials still waiting.
  ~GroupCommit();
  GroupCommit(const GroupCommit&) = delete;
  GroupCommit& operator=(const GroupCommit&) = delete;

  void add(std::vector<Trial> trials);

  /// Returns the trials committed since the last call, in the order in which they were added.
  /// Throws JournalError if the store refused a group.
  std::vector<Trial> take();

  /// Waits until take() has trials to return or an error to throw. Returns at once if no commit is
  /// in progress.
  void wait();

 private:
  void work();

  TrialStore* store_;
  std::mutex mutex_;  // guards the members below
  std::condition_variable changed_;
  std::vector<Trial> waiting_;
  std::vector<Trial> committed_;
  std::exception_ptr error_;
  bool writing_ = false;
  bool ending_ = false;
  std::thread writer_;  // the last member, because the thread uses all others
};

}  // namespace latsch
