// SPDX-License-Identifier: Apache-2.0
#include "evaluation/executors/thread_executor.h"

#include <gtest/gtest.h>

#include <atomic>
#include <latch>
#include <set>
#include <stdexcept>

#include "base/error.h"
#include "evaluation/schedule/scheduler.h"
#include "optimization/direct_search/gss.h"

namespace latsch {
namespace {

Result<Channels> square(const DesignPoint& point) {
  if (point.values[0] < 0.0) throw std::runtime_error("negative");
  Channels channels;
  channels.add({"y", "1", {point.values[0] * point.values[0]}});
  return channels;
}

TEST(ThreadExecutor, EveryThreadHasAnEvaluatorOfItsOwnAndTheyWorkAtTheSameTime) {
  std::atomic<int> made = 0;
  std::latch all_here(3);  // opens when three trials run at the same time
  const auto make = [&]() -> Evaluator {
    ++made;
    return [&](const DesignPoint& point) {
      all_here.arrive_and_wait();
      return square(point);
    };
  };
  ThreadExecutor executor(make, 3);
  for (double x : {1.0, 2.0, 3.0}) executor.start({{x}});
  std::set<double> values;
  while (values.size() < 3) {
    for (const Trial& trial : executor.wait(10.0)) {
      values.insert((*trial.outcome.result)["y"][0]);
    }
  }
  EXPECT_EQ(values, (std::set<double>{1.0, 4.0, 9.0}));
  EXPECT_EQ(made, 3);
  EXPECT_EQ(executor.idle(), 3);
}

TEST(ThreadExecutor, AnExceptionIsAFailureOfItsTrial) {
  ThreadExecutor executor([] { return square; }, 1);
  executor.start({{-1.0}});
  const std::vector<Trial> trials = executor.wait(10.0);
  ASSERT_EQ(trials.size(), 1u);
  EXPECT_EQ(trials[0].outcome.result.failure().reason, "negative");
}

TEST(ThreadExecutor, WhatIsWithdrawnIsNeverReported) {
  std::latch begun(1), may_end(1);
  ThreadExecutor executor(
      [&]() -> Evaluator {
        return [&](const DesignPoint& point) {
          if (point.values[0] == 1.0) {
            begun.count_down();
            may_end.wait();
          }
          return square(point);
        };
      },
      1);
  executor.start({{1.0}});
  begun.wait();
  executor.withdraw({{1.0}});
  EXPECT_EQ(executor.idle(), 0);  // the thread cannot be stopped, so it is not idle
  may_end.count_down();
  while (executor.idle() == 0) executor.wait(0.001);
  executor.start({{2.0}});
  const std::vector<Trial> trials = executor.wait(10.0);
  ASSERT_EQ(trials.size(), 1u);
  EXPECT_EQ(trials[0].point.values[0], 2.0);
}

TEST(ThreadExecutor, TrajectoryIsTheSameBitsForAnyNumberOfThreads) {
  const Objective target = [](const Channels& channels) -> Result<Score> {
    return Score{channels["y"][0]};
  };
  const auto run = [&](int workers) {
    ThreadExecutor executor([] { return square; }, workers);
    Gss gss(DesignSpace({{.name = "x", .lower = 0.1, .upper = 3.0, .initial = 2.0}}));
    std::string bits;
    for (const Step& step : run_optimizer(gss, target, executor, nullptr).steps) {
      bits += step.point.bits() + DesignPoint{{step.outcome->value}}.bits();
    }
    return bits;
  };
  const std::string reference = run(1);
  for (const int workers : {2, 4, 8}) EXPECT_EQ(run(workers), reference) << workers;
}

TEST(ThreadExecutor, NeedsAThread) {
  EXPECT_THROW(ThreadExecutor([] { return square; }, 0), InputError);
}

}  // namespace
}  // namespace latsch
