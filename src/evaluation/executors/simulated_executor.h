// SPDX-License-Identifier: Apache-2.0
// Workers in a simulated world: trials take seeded random times on a virtual clock and fail by a
// seeded lot, so that asynchrony can be tested in no time and repeated exactly.
#pragma once

#include <cstdint>
#include <vector>

#include "evaluation/executors/executor.h"

namespace latsch {

struct SimulatedOptions {
  int workers = 1;
  std::uint64_t seed = 0;
  double shortest = 0.5;  // s, trials take between
  double longest = 1.5;   // s, and this long, uniformly
  double failures =
      0.0;  // share of the points that fail; the same points for any number of workers
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
  double busy_time() const { return busy_time_; }  // s, summed over the workers
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
  long started_ = 0;  // number of the trial in the random stream
};

}  // namespace latsch
