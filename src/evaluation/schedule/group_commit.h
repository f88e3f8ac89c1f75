// SPDX-License-Identifier: Apache-2.0
// Writes finished trials to their store while workers go on.
//
// A commit waits for the disk, milliseconds a time. What finishes meanwhile is gathered and becomes
// the next commit, so that the disk is waited for once a group and never by a worker. A trial that
// was taken back from here is on the disk; before that it must not reach an optimizer.
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
  /// With `in_background` false, add() itself commits: for worlds with a clock of their own.
  /// Without a store nothing has to be kept.
  GroupCommit(TrialStore* store, bool in_background);
  /// Commits what it still has.
  ~GroupCommit();
  GroupCommit(const GroupCommit&) = delete;
  GroupCommit& operator=(const GroupCommit&) = delete;

  void add(std::vector<Trial> trials);

  /// Those committed since the last call, in the order they came. Throws JournalError where the
  /// store refused a group.
  std::vector<Trial> take();

  /// Waits until there is something to take, or an error to throw; at once where nothing is under
  /// way.
  void wait();

 private:
  void work();

  TrialStore* store_;
  std::mutex mutex_;  // of what follows
  std::condition_variable changed_;
  std::vector<Trial> waiting_;
  std::vector<Trial> committed_;
  std::exception_ptr error_;
  bool writing_ = false;
  bool ending_ = false;
  std::thread writer_;  // last: it works on all of these
};

}  // namespace latsch
