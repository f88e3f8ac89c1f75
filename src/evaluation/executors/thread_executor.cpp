// SPDX-License-Identifier: Apache-2.0
#include "evaluation/executors/thread_executor.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <utility>

#include "base/error.h"

namespace latsch {

ThreadExecutor::ThreadExecutor(const std::function<Evaluator()>& make, int workers)
    : slots_(std::max(workers, 0)) {
  if (workers < 1) throw InputError("worker threads need a number of at least 1");
  for (int i = 0; i < workers; ++i) {
    slots_[i].thread = std::thread([this, make, i] { work(make, i); });
  }
}

ThreadExecutor::~ThreadExecutor() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
    for (Slot& slot : slots_) slot.given.notify_one();
  }
  for (Slot& slot : slots_) slot.thread.join();
}

int ThreadExecutor::idle() const {
  const std::lock_guard lock(mutex_);
  return static_cast<int>(
      std::count_if(slots_.begin(), slots_.end(), [](const Slot& slot) { return !slot.point; }));
}

void ThreadExecutor::start(const DesignPoint& point) {
  const std::lock_guard lock(mutex_);
  const auto slot =
      std::find_if(slots_.begin(), slots_.end(), [](const Slot& s) { return !s.point; });
  assert(slot != slots_.end());
  slot->point = point;
  slot->begun = slot->forgotten = false;
  slot->given.notify_one();
}

std::vector<Trial> ThreadExecutor::wait(double patience) {
  std::unique_lock lock(mutex_);
  ended_.wait_for(
      lock, std::chrono::duration<double>(patience), [&] { return !finished_.empty(); });
  return std::exchange(finished_, {});
}

void ThreadExecutor::withdraw(const DesignPoint& point) {
  const std::lock_guard lock(mutex_);
  std::erase_if(finished_, [&](const Trial& trial) { return trial.point == point; });
  for (Slot& slot : slots_) {
    if (slot.point == point) forget(slot);
  }
}

void ThreadExecutor::abandon() {
  const std::lock_guard lock(mutex_);
  finished_.clear();
  for (Slot& slot : slots_) {
    if (slot.point) forget(slot);
  }
}

void ThreadExecutor::forget(Slot& slot) {
  if (slot.begun) {
    slot.forgotten = true;
  } else {
    slot.point.reset();
  }
}

void ThreadExecutor::work(const std::function<Evaluator()>& make, int worker) {
  const Evaluator evaluator = make();
  Slot& slot = slots_[worker];
  std::unique_lock lock(mutex_);
  while (true) {
    slot.given.wait(lock, [&] { return ending_ || slot.point; });
    if (ending_) return;
    slot.begun = true;
    const DesignPoint point = *slot.point;
    lock.unlock();
    Outcome outcome = evaluate(evaluator, point);
    outcome.worker = worker;
    lock.lock();
    slot.point.reset();
    if (slot.forgotten) continue;
    finished_.push_back({point, std::move(outcome)});
    ended_.notify_one();
  }
}

}  // namespace latsch
