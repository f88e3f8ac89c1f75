// SPDX-License-Identifier: Apache-2.0
// Workers that are threads of this process, for models that take less than a millisecond and can
// neither hang nor crash. A thread cannot be killed, so there is no timeout. A model that may crash
// or hang belongs in a ProcessExecutor, which costs some fifty microseconds more for each trial.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "evaluation/executors/executor.h"

namespace latsch {

class ThreadExecutor : public Executor {
 public:
  /// `make` is called once in every thread and returns an evaluator that no other thread uses.
  ThreadExecutor(const std::function<Evaluator()>& make, int workers);
  /// Waits for running trials.
  ~ThreadExecutor() override;

  int workers() const override { return static_cast<int>(slots_.size()); }
  int idle() const override;
  void start(const DesignPoint& point) override;
  std::vector<Trial> wait(double patience) override;
  /// Drops the outcome of the point. The worker stays busy until the trial ends.
  void withdraw(const DesignPoint& point) override;
  bool can_stop() const override { return false; }
  void abandon() override;

 private:
  struct Slot {
    std::optional<DesignPoint> point;
    bool begun = false;
    bool forgotten = false;
    std::condition_variable given;
    std::thread thread;
  };
  void work(const std::function<Evaluator()>& make, int worker);
  void forget(Slot& slot);

  mutable std::mutex mutex_;  // guards the members below
  std::condition_variable ended_;
  std::vector<Trial> finished_;
  bool ending_ = false;
  std::vector<Slot> slots_;
};

}  // namespace latsch
