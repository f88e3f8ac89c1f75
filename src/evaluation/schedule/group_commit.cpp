// SPDX-License-Identifier: Apache-2.0
#include "evaluation/schedule/group_commit.h"

#include <pthread.h>

#include <csignal>
#include <iterator>
#include <utility>

namespace latsch {
namespace {

void move_to(std::vector<Trial>& to, std::vector<Trial>&& from) {
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

/// Starts a thread that receives no signals. They go to the thread that waits for workers.
std::thread deaf_thread(auto&& body) {
  sigset_t all, before;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &before);
  std::thread thread(std::forward<decltype(body)>(body));
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return thread;
}

}  // namespace

GroupCommit::GroupCommit(TrialStore* store, bool in_background) : store_(store) {
  if (store && in_background) writer_ = deaf_thread([this] { work(); });
}

GroupCommit::~GroupCommit() {
  if (!writer_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  writer_.join();
}

void GroupCommit::add(std::vector<Trial> trials) {
  if (trials.empty()) return;
  if (!writer_.joinable()) {
    if (store_) store_->append(trials);
    return move_to(committed_, std::move(trials));
  }
  {
    const std::lock_guard lock(mutex_);
    move_to(waiting_, std::move(trials));
  }
  changed_.notify_all();
}

std::vector<Trial> GroupCommit::take() {
  const std::lock_guard lock(mutex_);
  if (error_) std::rethrow_exception(error_);
  return std::exchange(committed_, {});
}

void GroupCommit::wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock,
                [&] { return error_ || !committed_.empty() || (!writing_ && waiting_.empty()); });
}

void GroupCommit::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return ending_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    std::vector<Trial> group = std::exchange(waiting_, {});
    writing_ = true;
    lock.unlock();
    std::exception_ptr error;
    try {
      store_->append(group);
    } catch (...) {
      error = std::current_exception();
    }
    lock.lock();
    writing_ = false;
    if (error) {
      error_ = error;
      changed_.notify_all();
      return;
    }
    move_to(committed_, std::move(group));
    changed_.notify_all();
  }
}

}  // namespace latsch
