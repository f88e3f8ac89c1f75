// SPDX-License-Identifier: Apache-2.0
// Simulated workers: the duration of each trial is random on a virtual clock, and trials fail at
// random, both by a seed, so that asynchrony is tested without waiting and repeated exactly.
#pragma once

#include <cstdint>
#include <vector>

#include "evaluation/executors/executor.h"

namespace latsch {

struct SimulatedOptions {
  int workers = 1;
  std::uint64_t seed = 0;
  double shortest = 0.5;  // shortest duration of a trial, s
  double longest = 1.5;   // longest duration of a trial, s; durations are uniformly distributed
  double failures = 0.0;  // share of the points that fail, independent of the number of workers
};

class SimulatedExecutor : public Executor {
 public:
  SimulatedExecutor(Evaluator evaluator, SimulatedOptions options);

  int workers() const override { return options_.workers; }
  int idle() const override { return options_.workers - static_cast<int>(running_.size()); }
  void start(const DesignPoint& point) override;
  std::vector<Trial> wait(double patience) override;
  void withdraw(const DesignPoint& point) override;
  void abandon() override { running_.clear(); }

  double now() const override { return now_; }     // s on the virtual clock
  double busy_time() const { return busy_time_; }  // busy time of all workers together, s
  long started() const { return started_; }

 private:
  struct Running {
    DesignPoint point;
    double start;
    double end;
    int worker;
  };
  Evaluator evaluator_;
  SimulatedOptions options_;
  std::vector<Running> running_;
  double now_ = 0.0;
  double busy_time_ = 0.0;
  long started_ = 0;  // number of the next trial in the random stream
};

}  // namespace latsch
