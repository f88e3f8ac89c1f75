// SPDX-License-Identifier: Apache-2.0
#include "evaluation/schedule/scheduler.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <map>
#include <set>
#include <thread>

#include "base/random.h"
#include "base/scratch_folder_testing.h"
#include "evaluation/executors/inline_executor.h"
#include "evaluation/executors/simulated_executor.h"
#include "evaluation/schedule/faulty_world_testing.h"
#include "optimization/design/full_factorial.h"
#include "optimization/direct_search/gss.h"

namespace latsch {
namespace {

const StudyIdentity kScheduledStudy{{"model", "a function"}};

DesignSpace scheduler_space() {
  return DesignSpace(
      {{.name = "a", .lower = 0.1, .upper = 10.0, .initial = 4.0, .scale = Scale::logarithmic},
       {.name = "b", .lower = -1.0, .upper = 1.0, .initial = 0.8}});
}

Result<Channels> model(const DesignPoint& point) {
  Channels channels;
  channels.add({"y", "1", {std::log(point.values[0]), point.values[1]}});
  return channels;
}

Result<Score> scheduler_target(const Channels& channels) {
  const std::vector<double>& y = channels["y"];
  return Score{std::abs(y[0] - 0.3) + std::abs(y[0] + y[1]) + 0.1 * y[1] * y[1]};
}

/// Returns all bits of a trajectory as a text.
std::string bits(const Run& run) {
  std::string all = std::to_string(static_cast<int>(run.end));
  for (const Step& step : run.steps) {
    all += step.point.bits();
    all += step.outcome ? DesignPoint{{step.outcome->value}}.bits() : step.outcome.failure().reason;
  }
  return all;
}

Run run_simulated(const SimulatedOptions& simulated, Journal* journal, RunOptions options = {}) {
  options.commit_in_background = false;
  SimulatedExecutor executor(model, simulated);
  Gss gss(scheduler_space());
  return run_optimizer(gss, scheduler_target, executor, journal, options);
}

TEST(RunOptimizer, TrajectoryIsTheSameBitsForAnyNumberOfWorkersAndAnyTiming) {
  for (const double failures : {0.0, 0.1}) {
    const std::string reference = bits(run_simulated({.failures = failures}, nullptr));
    EXPECT_GT(reference.size(), 1000u);
    for (const int workers : {1, 2, 3, 4, 8, 16}) {
      for (std::uint64_t timing = 0; timing < 5; ++timing) {
        SimulatedOptions simulated{.workers = workers, .seed = 0, .failures = failures};
        // The delays differ, but the same points fail.
        simulated.shortest = 0.1 + 0.3 * static_cast<double>(timing);
        simulated.longest = 3.0 + static_cast<double>(timing);
        EXPECT_EQ(bits(run_simulated(simulated, nullptr)), reference) << workers << " workers";
      }
    }
  }
}

TEST(RunOptimizer, LookAheadDoesNotReachTheTrajectory) {
  const std::string reference = bits(run_simulated({}, nullptr));
  for (const int look_ahead : {1, 2, 7}) {
    EXPECT_EQ(bits(run_simulated({.workers = 3}, nullptr, {.look_ahead = look_ahead})), reference);
  }
}

TEST(RunOptimizer, OneWorkerEvaluatesNothingInVain) {
  SimulatedExecutor executor(model, {});
  Gss gss(scheduler_space());
  const auto run = run_optimizer(gss, scheduler_target, executor, nullptr);
  EXPECT_EQ(executor.started(), std::ssize(run.steps));
}

TEST(RunOptimizer, MoreWorkersTakeLessTime) {
  const auto time = [](int workers) {
    SimulatedExecutor executor(model, {.workers = workers});
    Gss gss(scheduler_space());
    (void)run_optimizer(gss, scheduler_target, executor, nullptr);
    return executor.now();
  };
  EXPECT_LT(time(2), 0.8 * time(1));
}

TEST(RunOptimizer, EndsAfterTheLargestNumberOfSteps) {
  const auto run = run_simulated({.workers = 2}, nullptr, {.max_steps = 7});
  EXPECT_EQ(run.end, RunEnd::max_steps);
  EXPECT_EQ(run.steps.size(), 7u);
  EXPECT_NE(run.ending.find("max_steps"), std::string::npos) << run.ending;
  ASSERT_EQ(run.claims.size(), 1u);
  EXPECT_EQ(run.claims[0].statement, "stopped early");
  ASSERT_FALSE(run.claims[0].numbers.empty());
  EXPECT_EQ(run.claims[0].numbers[0].value, 7.0);
}

TEST(RunOptimizer, SaysWhyItEnded) {
  const auto whole = run_simulated({.workers = 2}, nullptr);
  EXPECT_EQ(whole.ending.find("where no direction gains"), 0u);
  ASSERT_EQ(whole.claims.size(), 1u);
  EXPECT_EQ(whole.claims[0].statement, whole.ending);
  InlineExecutor fails([](const DesignPoint&) { return Result<Channels>(Failure{"no"}); });
  Gss gss(scheduler_space());
  const auto run = run_optimizer(gss, scheduler_target, fails, nullptr);
  EXPECT_EQ(run.ending, "without a result: every trial failed");
}

TEST(RunOptimizer, AnObjectiveThatIsNotFiniteIsAFailedStep) {
  InlineExecutor executor(model);
  Gss gss(scheduler_space());
  const auto run = run_optimizer(
      gss, [](const Channels&) { return Score{std::nan("")}; }, executor, nullptr);
  EXPECT_EQ(run.best(), nullptr);
  EXPECT_EQ(run.end, RunEnd::converged);
}

TEST(RunOptimizer, ReportsProgress) {
  RunProgress last;
  RunOptions options;
  options.on_progress = [&](const RunProgress& progress) { last = progress; };
  const auto run = run_simulated({.workers = 2, .failures = 0.1}, nullptr, options);
  EXPECT_EQ(last.known, std::ssize(run.steps));
  EXPECT_GE(last.evaluated, last.known);
  EXPECT_GT(last.failed, 0);
  ASSERT_TRUE(last.best.has_value());
  EXPECT_EQ(*last.best, run.best()->outcome->value);
  EXPECT_EQ(last.best_point, run.best()->point);
}

// A study is stopped at random moments and resumed with another number of workers until it ends.
// The moments and all delays depend on a seed and a virtual clock.
TEST(RunOptimizer, ARunInterruptedAnywhereGivesTheSameBitsAndRepeatsNoFinishedTrial) {
  const std::string reference = bits(run_simulated({.failures = 0.05}, nullptr));
  for (std::uint64_t history = 0; history < 30; ++history) {
    FaultyStore store(0.0, 0);  // a store that refuses nothing
    RandomStream random(7, history);
    std::map<std::string, int> evaluations;
    const Evaluator counting = [&](const DesignPoint& point) {
      ++evaluations[point.bits()];
      return model(point);
    };
    for (bool finished = false; !finished;) {
      const int workers = 1 + static_cast<int>(random.below(5));
      SimulatedExecutor executor(counting, {.workers = workers, .failures = 0.05});
      const long trials = static_cast<long>(random.below(25));
      RunOptions options;
      options.stop_patience = 0.0;
      options.commit_in_background = false;
      options.stop_requested = [&] { return executor.started() > trials; };
      Gss gss(scheduler_space());
      const auto run = run_optimizer(gss, scheduler_target, executor, &store, options);
      finished = run.end == RunEnd::converged;
      if (finished) {
        EXPECT_EQ(bits(run), reference) << "history " << history;
      }
    }
    for (const auto& [point, count] : evaluations) EXPECT_EQ(count, 1) << "history " << history;
  }
}

TEST(RunOptimizer, AFinishedStudyIsReplayedWithoutEvaluating) {
  const ScratchFolder folder;
  Journal journal = Journal::open(folder / "j", kScheduledStudy);
  const auto run = run_simulated({.workers = 4}, &journal);
  Gss again(scheduler_space());
  EXPECT_EQ(bits(replay(again, scheduler_target, journal)), bits(run));
  Gss part(scheduler_space());
  EXPECT_EQ(replay(part, scheduler_target, journal, 5).steps.size(), 5u);
}

TEST(RunOptimizer, AnotherObjectiveReusesTheChannels) {
  const ScratchFolder folder;
  Journal journal = Journal::open(folder / "j", kScheduledStudy);
  const auto run = run_simulated({}, &journal);
  const Objective twice = [](const Channels& channels) -> Result<Score> {
    return Score{2.0 * scheduler_target(channels)->value};
  };
  Gss gss(scheduler_space(), {.sufficient_decrease = 0.02});
  const auto same = replay(gss, twice, journal);
  ASSERT_EQ(same.steps.size(), run.steps.size());
  EXPECT_EQ(same.steps.back().outcome->value, 2.0 * run.steps.back().outcome->value);
}

TEST(RunDoe, EvaluatesEveryPointOnceWhateverHappens) {
  const ScratchFolder folder;
  const SamplingPlan plan = full_factorial(scheduler_space(), {7, 5});
  int evaluations = 0;
  const Evaluator counting = [&](const DesignPoint& point) {
    ++evaluations;
    return model(point);
  };
  for (const int workers : {1, 3, 2}) {
    Journal journal = Journal::open(folder / "j", kScheduledStudy);
    SimulatedExecutor executor(counting, {.workers = workers});
    RunOptions options;
    options.stop_patience = 0.0;
    if (workers != 2) options.stop_requested = [&] { return executor.started() > 12; };
    const RunEnd end = run_doe(plan, executor, journal, options);
    EXPECT_EQ(end, workers == 2 ? RunEnd::converged : RunEnd::stopped);
  }
  EXPECT_EQ(evaluations, 35);
  std::set<std::string> points;
  for (const Trial& trial : Journal::read(folder / "j").trials()) points.insert(trial.point.bits());
  EXPECT_EQ(points.size(), 35u);
}

TEST(RunDoe, KeepsAllWorkersBusy) {
  const ScratchFolder folder;
  Journal journal = Journal::open(folder / "j", kScheduledStudy);
  SimulatedExecutor executor(model, {.workers = 4});
  ASSERT_EQ(run_doe(full_factorial(scheduler_space(), {10, 10}), executor, journal),
            RunEnd::converged);
  // Workers may be idle only at the end, while the last trials run, which take at most 1.5 s.
  EXPECT_GE(executor.busy_time(), 4.0 * (executor.now() - 1.5));
}

}  // namespace
}  // namespace latsch
