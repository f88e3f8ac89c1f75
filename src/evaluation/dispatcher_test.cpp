// SPDX-License-Identifier: Apache-2.0
// Failure policies, stragglers and seeded histories in virtual time.
#include "evaluation/dispatcher.h"

#include <gtest/gtest.h>

#include <array>

#include "evaluation/scheduler_history_testing.h"
#include "optimization/gss.h"

namespace latsch {
namespace {

SamplingPlan plan(int points) {
  SamplingPlan plan;
  for (int i = 0; i < points; ++i) plan.points.push_back({{1.0 * i}});
  return plan;
}

RunOptions virtual_time() {
  RunOptions options;
  options.commit_in_background = false;
  return options;
}

/// Workers that answer to their trials by a script: what, and after how many seconds.
class Scripted : public Executor {
 public:
  struct Answer {
    double time = 1.0;
    Result<Channels> result = Channels{};
  };
  using Script = std::function<Answer(const DesignPoint&, int attempt)>;

  Scripted(int workers, Script script) : workers_(workers), script_(std::move(script)) {}
  int workers() const override { return workers_; }
  int idle() const override { return workers_ - static_cast<int>(running_.size()); }
  void start(const DesignPoint& point) override {
    Answer answer = script_(point, ++attempts_[point.bits()]);
    running_.push_back({now_ + answer.time, {point, {answer.result, answer.time}}});
  }
  std::vector<Trial> wait(double patience) override {
    const auto first =
        std::min_element(running_.begin(), running_.end(), [](const auto& a, const auto& b) {
          return a.first < b.first;
        });
    if (first == running_.end() || first->first > now_ + patience) {
      now_ += patience;
      return {};
    }
    now_ = first->first;
    const Trial trial = first->second;
    running_.erase(first);
    return {trial};
  }
  void withdraw(const DesignPoint& point) override {
    withdrawn_ +=
        std::erase_if(running_, [&](const auto& entry) { return entry.second.point == point; });
  }
  void abandon() override { running_.clear(); }
  double now() const override { return now_; }

  int attempts(double x) { return attempts_[DesignPoint{{x}}.bits()]; }
  long withdrawn() const { return withdrawn_; }

 private:
  int workers_;
  Script script_;
  std::vector<std::pair<double, Trial>> running_;
  std::map<std::string, int> attempts_;
  double now_ = 0.0;
  long withdrawn_ = 0;
};

Scripted::Script failing(double x, Cause cause, int attempts) {
  return [=](const DesignPoint& point, int attempt) -> Scripted::Answer {
    if (point.values[0] == x && attempt <= attempts) return {1.0, Failure{"no", cause}};
    return {};
  };
}

TEST(FailurePolicy, ALostWorkerIsForgivenTwiceWhateverThePolicy) {
  for (const int losses : {1, 2, 3}) {
    FaultyStore store(0.0, 0);
    Scripted executor(2, failing(3.0, Cause::transient, losses));
    EXPECT_EQ(run_doe(plan(6), executor, store, virtual_time()), RunEnd::converged);
    EXPECT_EQ(executor.attempts(3.0), std::min(losses + 1, 3));
    int failed = 0;
    store.for_each([&](const Trial& trial) { failed += !trial.outcome.result; });
    EXPECT_EQ(failed, losses == 3);
  }
}

TEST(FailurePolicy, OtherFailuresAreFinalUnlessRetriesAreAskedFor) {
  for (const Cause cause : {Cause::point, Cause::timeout, Cause::bad_output}) {
    for (const int retries : {0, 1, 2}) {
      FaultyStore store(0.0, 0);
      Scripted executor(2, failing(3.0, cause, 2));
      RunOptions options = virtual_time();
      options.on_failure.retries = retries;
      EXPECT_EQ(run_doe(plan(6), executor, store, options), RunEnd::converged);
      EXPECT_EQ(executor.attempts(3.0), retries + 1);
      EXPECT_EQ(store.size(), 6);
      std::string reason;
      store.for_each([&](const Trial& trial) {
        if (!trial.outcome.result) reason = trial.outcome.result.failure().reason;
      });
      const std::array expected{"no", "no (attempt 2 of 2)", ""};
      EXPECT_EQ(reason, expected[retries]);
    }
  }
}

TEST(FailurePolicy, AbortEndsTheRunAtTheFailedStep) {
  FaultyStore store(0.0, 0);
  Scripted executor(2, failing(3.0, Cause::point, 99));
  RunOptions options = virtual_time();
  options.on_failure.then = FailurePolicy::Then::abort;
  EXPECT_EQ(run_doe(plan(100), executor, store, options), RunEnd::aborted);
  EXPECT_LT(store.size(), 10);

  const Objective target = [](const Channels&) -> Result<Score> { return Failure{"no"}; };
  Gss gss(DesignSpace({{.name = "x"}}));
  const auto run = run_optimizer(gss, target, executor, nullptr, options);
  EXPECT_EQ(run.end, RunEnd::aborted);
  ASSERT_EQ(run.steps.size(), 1u);
  EXPECT_EQ(run.steps[0].outcome.failure().reason, "no");
}

// Nine trials of a second, a tenth whose worker stalls: its copy ends the plan.
TEST(Stragglers, AreStartedOnceMoreWhereAWorkerIsIdle) {
  FaultyStore store(0.0, 0);
  Scripted executor(2, [](const DesignPoint& point, int attempt) -> Scripted::Answer {
    return {point.values[0] == 4.0 && attempt == 1 ? 1000.0 : 1.0};
  });
  EXPECT_EQ(run_doe(plan(10), executor, store, virtual_time()), RunEnd::converged);
  EXPECT_EQ(executor.attempts(4.0), 2);
  EXPECT_EQ(executor.withdrawn(), 1);
  EXPECT_EQ(store.size(), 10);
  EXPECT_LT(executor.now(), 15.0);
}

TEST(Stragglers, ACopyThatIsLostOrTimesOutDoesNotCountWhileTheOtherRuns) {
  for (const Cause cause : {Cause::transient, Cause::timeout}) {
    FaultyStore store(0.0, 0);
    Scripted executor(2, [=](const DesignPoint& point, int attempt) -> Scripted::Answer {
      if (point.values[0] != 4.0) return {};
      if (attempt == 1) return {30.0};
      return {1.0, Failure{"lost", cause}};
    });
    EXPECT_EQ(run_doe(plan(10), executor, store, virtual_time()), RunEnd::converged);
    store.for_each([](const Trial& trial) { EXPECT_TRUE(trial.outcome.result.ok()); });
  }
}

TEST(Stragglers, AreLeftAloneWhereThatIsAskedFor) {
  FaultyStore store(0.0, 0);
  Scripted executor(2, [](const DesignPoint& point, int) -> Scripted::Answer {
    return {point.values[0] == 4.0 ? 100.0 : 1.0};
  });
  RunOptions options = virtual_time();
  options.straggler_factor = 0.0;
  EXPECT_EQ(run_doe(plan(10), executor, store, options), RunEnd::converged);
  EXPECT_EQ(executor.attempts(4.0), 1);
}

/// Names {x, 1000 + x} at its step x: what is speculated on never comes true.
class Forgetful : public Optimizer {
 public:
  std::vector<DesignPoint> propose(int count) const override {
    std::vector<DesignPoint> points{{{x_}}, {{1000.0 + x_}}};
    points.resize(std::min(count, 2));
    return points;
  }
  void observe(const DesignPoint&, const Result<Score>&) override { x_ += 1.0; }
  bool converged() const override { return x_ >= 30.0; }

 private:
  double x_ = 0.0;
};

// The speculation that stalls holds one of two workers for good unless it is stopped.
TEST(Stragglers, AreStoppedWhereNobodyNamesThemAndAWantedPointWaits) {
  const auto time = [](bool stop, long& stopped) {
    Scripted executor(2, [](const DesignPoint& point, int) -> Scripted::Answer {
      return {point.values[0] == 1009.0 ? 1e6 : 1.0};
    });
    RunOptions options = virtual_time();
    options.stop_unwanted = stop;
    options.on_progress = [&](const RunProgress& progress) { stopped = progress.stopped; };
    Forgetful optimizer;
    const Objective any = [](const Channels&) -> Result<Score> { return Score{}; };
    const auto run = run_optimizer(optimizer, any, executor, nullptr, options);
    EXPECT_EQ(run.steps.size(), 30u);
    EXPECT_EQ(executor.attempts(1009.0), 1);
    return executor.now();
  };
  long with = 0, without = 0;
  EXPECT_LE(time(true, with), time(false, without));
  EXPECT_EQ(with, 1);
  EXPECT_EQ(without, 0);
}

// The short form of ./bench.sh scheduler_simulation.
TEST(SchedulerInVirtualTime, LosesAndRepeatsNothingAndGivesTheSameBitsInEveryHistory) {
  const SearchProblem problem = two_variable_search();
  const std::string reference = undisturbed(problem, 0.05);
  EXPECT_GT(reference.size(), 1000u);
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const History history = live_through(problem, seed, 0.05);
    EXPECT_EQ(history.wrong, "") << "seed " << seed;
    EXPECT_TRUE(history.bits == reference) << "other bits, seed " << seed;
  }
}

TEST(SchedulerInVirtualTime, ASeedIsOneHistory) {
  const SearchProblem problem = two_variable_search();
  const History once = live_through(problem, 17, 0.05);
  const History again = live_through(problem, 17, 0.05);
  EXPECT_EQ(once.restarts, again.restarts);
  EXPECT_EQ(once.repeats, again.repeats);
  EXPECT_EQ(once.evaluations, again.evaluations);
}

}  // namespace
}  // namespace latsch
