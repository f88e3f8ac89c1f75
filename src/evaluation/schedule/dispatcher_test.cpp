// SPDX-License-Identifier: Apache-2.0
// Tests failure policies, stragglers and simulated runs with seeded faults, all in virtual time.
#include "evaluation/schedule/dispatcher.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "evaluation/schedule/scheduler_history_testing.h"
#include "optimization/direct_search/gss.h"

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

/// Workers whose outcomes come from a script, which returns the outcome of a trial and its delay in
/// seconds.
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
    if (now_ > kTooLong) throw std::runtime_error("the run does not come to its end");
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
  /// Advances the virtual clock while trials run.
  void let_pass(double time) { now_ += time; }

  static constexpr double kTooLong = 1e4;  // s

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

TEST(FailurePolicy, ALostWorkerIsForgivenOnceMoreThanAFailure) {
  for (const int retries : {0, 1, 2}) {
    for (const int losses : {1, 2, 3, 4}) {
      FaultyStore store(0.0, 0);
      Scripted executor(2, failing(3.0, Cause::transient, losses));
      RunOptions options = virtual_time();
      options.on_failure.retries = retries;
      EXPECT_EQ(run_doe(plan(6), executor, store, options), RunEnd::converged);
      EXPECT_EQ(executor.attempts(3.0), std::min(losses + 1, retries + 2));
      int failed = 0;
      store.for_each([&](const Trial& trial) { failed += !trial.outcome.result; });
      EXPECT_EQ(failed, losses >= retries + 2);
    }
  }
}

// A node on which no worker can be started any more accepts points and loses them. Such a loss is
// not an attempt at the point and uses up no start; only real attempts count against the limit.
TEST(FailurePolicy, AWorkerThatIsLostBeforeItBeginsCostsNoStart) {
  for (const int retries : {0, 1}) {
    const int losses = retries + 2;
    const auto script = [&](int allowed) -> Scripted::Script {
      return [=](const DesignPoint& point, int attempt) -> Scripted::Answer {
        if (point.values[0] != 3.0) return {};
        // Every first attempt of two is lost before it begins; in the second one a worker starts
        // and crashes.
        if (attempt % 2 == 1) return {1.0, Failure{"no worker", Cause::not_begun}};
        if (attempt / 2 <= allowed) return {1.0, Failure{"killed", Cause::transient}};
        return {};
      };
    };
    for (const int allowed : {0, losses - 1, losses}) {
      FaultyStore store(0.0, 0);
      Scripted executor(2, script(allowed));
      RunOptions options = virtual_time();
      options.on_failure.retries = retries;
      EXPECT_EQ(run_doe(plan(6), executor, store, options), RunEnd::converged);
      int failed = 0;
      store.for_each([&](const Trial& trial) { failed += !trial.outcome.result; });
      EXPECT_EQ(failed, allowed >= losses) << retries << " retries, " << allowed << " killed";
      EXPECT_EQ(executor.attempts(3.0), 2 * std::min(allowed + 1, losses));
    }
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

// Nine trials take a second each. The worker of the tenth stalls, and a copy of this trial
// completes the plan.
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

const Objective kAny = [](const Channels&) -> Result<Score> { return Score{}; };

/// An optimizer that proposes the point x in step x, followed by the next points as speculation.
class Counting : public Optimizer {
 public:
  explicit Counting(double steps) : steps_(steps) {}
  std::vector<DesignPoint> propose(int count) const override {
    std::vector<DesignPoint> points{{{x_}}};
    if (const auto next = speculation(x_)) points.push_back({{*next}});
    points.resize(std::min<std::size_t>(count, points.size()));
    return points;
  }
  void observe(const DesignPoint&, const Result<Score>&) override { x_ += 1.0; }
  bool converged() const override { return x_ >= steps_; }

 private:
  virtual std::optional<double> speculation(double) const { return std::nullopt; }
  double steps_, x_ = 0.0;
};

/// An optimizer that proposes only the next point, without speculation.
struct Patient : Counting {
  Patient() : Counting(30.0) {}
};

/// An optimizer whose speculative points are never requested.
struct Forgetful : Counting {
  Forgetful() : Counting(30.0) {}
  std::optional<double> speculation(double x) const override { return 1000.0 + x; }
};

/// An optimizer that sometimes requests an earlier point again.
struct Insistent : Counting {
  Insistent() : Counting(200.0) {}
  std::vector<DesignPoint> propose(int count) const override {
    std::vector<DesignPoint> points = Counting::propose(count);
    const double x = points[0].values[0];
    if (std::fmod(x, 10.0) < 5.0) {
      points = {{{x}}, {{1000.0}}};
    } else {
      points = {{{x}}, {{x + 1.0}}, {{x + 2.0}}, {{x + 3.0}}};
    }
    points.resize(std::min<std::size_t>(count, points.size()));
    return points;
  }
};

/// An optimizer that takes time to propose each point.
struct Thoughtful : Counting {
  Thoughtful(Scripted& clock_, double time_) : Counting(60.0), clock(clock_), time(time_) {}
  std::vector<DesignPoint> propose(int count) const override {
    clock.let_pass(time * count);
    proposed += count;
    std::vector<DesignPoint> points;
    const double x = Counting::propose(1)[0].values[0];
    for (int i = 0; i < count; ++i) points.push_back({{i == 0 ? x : 1000.0 * x + i}});
    return points;
  }
  Scripted& clock;
  double time;
  mutable int proposed = 0;
};

/// Returns a script in which every attempt at `x` hangs until its time limit.
Scripted::Script hanging_at(double x) {
  return [=](const DesignPoint& point, int) -> Scripted::Answer {
    if (point.values[0] != x) return {};
    return {20.0, Failure{"took more than the 20 s allowed", Cause::timeout}};
  };
}

// Two workers have no other trials: one runs the point, the other runs copies of it.
TEST(Stragglers, APointThatHangsIsStartedTwiceAndThenCounts) {
  for (const int workers : {1, 2, 3, 8}) {
    for (const int retries : {0, 1, 3}) {
      FaultyStore store(0.0, 0);
      Scripted executor(workers, hanging_at(9.0));
      RunOptions options = virtual_time();
      options.on_failure.retries = retries;
      EXPECT_EQ(run_doe(plan(10), executor, store, options), RunEnd::converged);
      EXPECT_LE(executor.attempts(9.0), retries + 2) << workers << " workers";
      EXPECT_EQ(store.size(), 10);
      EXPECT_LT(executor.now(), 20.0 * (retries + 2) + 20.0);
    }
  }
}

// Regression test: methods that use residuals sometimes have a single point to evaluate and propose
// nothing else meanwhile.
TEST(Stragglers, ASearchGoesOnBehindAPointThatHangs) {
  Scripted executor(2, hanging_at(17.0));
  Patient optimizer;
  const auto run = run_optimizer(optimizer, kAny, executor, nullptr, virtual_time());
  ASSERT_EQ(run.steps.size(), 30u);
  EXPECT_FALSE(run.steps[17].outcome.ok());
  EXPECT_EQ(run.steps[17].outcome.failure().cause, Cause::timeout);
  EXPECT_EQ(executor.attempts(17.0), 2);
}

// The operating system sometimes delays a model that takes a tenth of a millisecond. Such a trial
// is no straggler.
TEST(Stragglers, AreNoneBelowWhatTheSystemTakes) {
  FaultyStore store(0.0, 0);
  Scripted executor(2, [](const DesignPoint& point, int) -> Scripted::Answer {
    return {point.values[0] == 9.0 ? 0.04 : 1e-4};
  });
  EXPECT_EQ(run_doe(plan(10), executor, store, virtual_time()), RunEnd::converged);
  EXPECT_EQ(executor.attempts(9.0), 1);
}

// Two copies of a trial run. If one exceeds its time limit, this failure describes the point and is
// kept; the later loss of the other copy's worker does not describe it.
TEST(Stragglers, WhatIsKeptOfTwoCopiesIsWhatTellsMore) {
  FaultyStore store(0.0, 0);
  Scripted executor(2, [](const DesignPoint& point, int attempt) -> Scripted::Answer {
    if (point.values[0] != 9.0) return {};
    if (attempt == 1) return {20.0, Failure{"too long", Cause::timeout}};
    return {30.0, Failure{"killed", Cause::transient}};
  });
  EXPECT_EQ(run_doe(plan(10), executor, store, virtual_time()), RunEnd::converged);
  EXPECT_EQ(executor.attempts(9.0), 2);
  store.for_each([](const Trial& trial) {
    if (trial.outcome.result) return;
    EXPECT_EQ(trial.outcome.result.failure().reason, "too long (attempt 2 of 2)");
    EXPECT_EQ(trial.outcome.result.failure().cause, Cause::timeout);
  });
}

// The point straggles as speculation, is stopped in favor of a requested point, and is requested
// again, several times. Its number of starts is kept.
TEST(Stragglers, APointThatIsStoppedKeepsItsCount) {
  Scripted executor(2, [](const DesignPoint& point, int) -> Scripted::Answer {
    return {point.values[0] == 1000.0 ? 1e5 : 1.0};
  });
  Insistent optimizer;
  const auto run = run_optimizer(optimizer, kAny, executor, nullptr, virtual_time());
  EXPECT_EQ(run.steps.size(), 200u);
  EXPECT_LE(executor.attempts(1000.0), 2);
}

TEST(Stragglers, AreCounted) {
  RunProgress last;
  int most = 0;
  double slowest = 0.0;
  RunOptions options = virtual_time();
  options.on_progress = [&](const RunProgress& progress) {
    last = progress;
    most = std::max(most, progress.straggling);
    slowest = std::max(slowest, progress.slowest);
  };
  FaultyStore store(0.0, 0);
  Scripted executor(2, hanging_at(9.0));
  EXPECT_EQ(run_doe(plan(10), executor, store, options), RunEnd::converged);
  EXPECT_EQ(last.copied, 1);
  EXPECT_EQ(last.repeated, 0);
  EXPECT_EQ(most, 1);
  EXPECT_NEAR(slowest, 23.0, 0.5);  // the copy of the slowest trial began after 3 s
  EXPECT_EQ(last.straggling, 0);
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

// The speculative trial that stalls occupies one of two workers forever unless it is stopped.
TEST(Stragglers, AreStoppedWhereNobodyNamesThemAndAWantedPointWaits) {
  const auto time = [](bool stop, long& stopped) {
    Scripted executor(2, [](const DesignPoint& point, int) -> Scripted::Answer {
      return {point.values[0] == 1009.0 ? 1e6 : 1.0};
    });
    RunOptions options = virtual_time();
    options.stop_unwanted = stop;
    options.on_progress = [&](const RunProgress& progress) { stopped = progress.stopped; };
    Forgetful optimizer;
    const auto run = run_optimizer(optimizer, kAny, executor, nullptr, options);
    EXPECT_EQ(run.steps.size(), 30u);
    EXPECT_EQ(executor.attempts(1009.0), 1);
    return executor.now();
  };
  long with = 0, without = 0;
  EXPECT_LE(time(true, with), time(false, without));
  EXPECT_EQ(with, 1);
  EXPECT_EQ(without, 0);
}

// Trials that end while the optimizer is computing are noticed late; their long waiting time does
// not make them stragglers.
TEST(Stragglers, AreNotWhatWaitedForTheOptimizer) {
  RunProgress last;
  RunOptions options = virtual_time();
  options.on_progress = [&](const RunProgress& progress) { last = progress; };
  Scripted executor(2, [](const DesignPoint&, int) -> Scripted::Answer { return {2.0}; });
  Thoughtful optimizer(executor, 1.0);
  run_optimizer(optimizer, kAny, executor, nullptr, options);
  EXPECT_EQ(last.stopped, 0);
  EXPECT_EQ(last.copied, 0);
}

// If computing a speculative point takes a second, it is not worth a trial that takes a tenth of a
// second.
TEST(LookingAhead, EndsWhereThinkingTakesLongerThanTrials) {
  const auto proposed = [](double trial) {
    Scripted executor(4, [=](const DesignPoint&, int) -> Scripted::Answer { return {trial}; });
    Thoughtful optimizer(executor, 1.0);
    run_optimizer(optimizer, kAny, executor, nullptr, virtual_time());
    return optimizer.proposed;
  };
  EXPECT_LT(proposed(0.1), 200);
  EXPECT_GT(proposed(100.0), 60 * 16);
}

// A resumed run knows the outcomes of all trials of the earlier run, so it requests no speculation.
TEST(LookingAhead, IsLeftOutWhereTheOutcomeIsKnown) {
  FaultyStore store(0.0, 0);
  for (const bool resumed : {false, true}) {
    Scripted executor(4, [](const DesignPoint&, int) -> Scripted::Answer { return {100.0}; });
    Thoughtful optimizer(executor, 1.0);
    run_optimizer(optimizer, kAny, executor, &store, virtual_time());
    EXPECT_EQ(optimizer.proposed > 60, !resumed);
  }
}

// ./bench.sh scheduler_simulation repeats this test with many more seeds. Here each mix of hanging
// points, lost workers, stalls and failing points runs eight times.
TEST(SchedulerInVirtualTime, LosesAndRepeatsNothingAndGivesTheSameBitsInEveryHistory) {
  Undisturbed reference(two_variable_search());
  long expired = 0, repeats = 0;
  int most = 0;
  for (std::uint64_t seed = 0; seed < 16 * 8; ++seed) {
    const History history = live_through(reference, seed);
    EXPECT_EQ(history.wrong, "") << "seed " << seed;
    EXPECT_GT(history.bits.size(), 1000u) << "seed " << seed;
    expired += history.expired;
    repeats += history.repeats;
    most = std::max(most, history.most_starts);
  }
  EXPECT_GT(expired, 60);
  EXPECT_GT(repeats, 300);
  EXPECT_GE(most, 4);  // failures are repeated up to the limit
}

// Regression test: if an outcome arrived twice, the second time while its point waited for a
// worker, it was counted twice.
TEST(SchedulerInVirtualTime, WhatIsToldTwiceStartsNothing) {
  Undisturbed reference(two_variable_search());
  for (const std::uint64_t seed : {2430, 8843}) {
    EXPECT_EQ(live_through(reference, seed).wrong, "") << "seed " << seed;
  }
}

TEST(SchedulerInVirtualTime, ASeedIsOneHistory) {
  Undisturbed reference(two_variable_search());
  const History once = live_through(reference, 15);
  const History again = live_through(reference, 15);
  EXPECT_EQ(once.restarts, again.restarts);
  EXPECT_EQ(once.repeats, again.repeats);
  EXPECT_EQ(once.evaluations, again.evaluations);
}

}  // namespace
}  // namespace latsch
