// SPDX-License-Identifier: Apache-2.0
// Tests a model that fails at points beyond a distance from the center, and the values that its
// optimizer receives for these points.
#include "evaluation/schedule/failure_answer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "base/random.h"
#include "evaluation/executors/simulated_executor.h"
#include "evaluation/schedule/faulty_world_testing.h"
#include "evaluation/schedule/scheduler.h"
#include "optimization/direct_search/gss.h"

namespace latsch {
namespace {

using Then = FailurePolicy::Then;

constexpr double kRadius = 0.55;  // distance from the center beyond which the model fails

DesignSpace answer_space() {
  return DesignSpace({{.name = "a", .lower = 0.0, .upper = 1.0, .initial = 0.6},
                      {.name = "b", .lower = 0.0, .upper = 1.0, .initial = 0.4}});
}

Result<Channels> disk(const DesignPoint& point) {
  const double distance = std::hypot(point.values[0] - 0.5, point.values[1] - 0.5);
  if (distance > kRadius) return Failure{"beyond the edge"};
  Channels channels;
  channels.add({"y", "1", point.values});
  return channels;
}

/// Returns a target function whose minimum lies in the region where the model fails.
Result<Score> answer_target(const Channels& channels) {
  const std::vector<double>& y = channels["y"];
  const std::vector<double> r{y[0] - 1.1, 0.5 * (y[1] - 1.0), 0.1 * y[0]};
  return Score{r[0] * r[0] + r[1] * r[1] + r[2] * r[2], r};
}

std::string bits(const latsch::Run& run) {
  std::string all = std::to_string(static_cast<int>(run.end));
  for (const Step& step : run.steps) {
    all += step.point.bits();
    if (step.outcome) all += DesignPoint{{step.outcome->value}}.bits();
    if (step.answer) all += DesignPoint{{step.answer->value}}.bits();
  }
  return all;
}

RunOptions options(Then then) {
  RunOptions options;
  options.commit_in_background = false;
  options.on_failure = {.then = then, .penalty = 5.0, .halvings = 6, .space = answer_space()};
  return options;
}

/// An optimizer that stops as soon as it receives a failure.
class TakesNoFailure : public Optimizer {
 public:
  std::vector<DesignPoint> propose(int count) const override { return gss_.propose(count); }
  void observe(const DesignPoint& point, const Result<Score>& outcome) override {
    if (!outcome) throw std::runtime_error("a failure reached it");
    residuals_.insert(outcome->residuals.size());
    gss_.observe(point, outcome);
  }
  bool converged() const override { return gss_.converged(); }
  const std::set<std::size_t>& residuals() const { return residuals_; }

 private:
  Gss gss_{answer_space()};
  std::set<std::size_t> residuals_;  // all numbers of residuals that it received
};

TEST(Recover, AMethodThatCannotTakeAFailureGoesOnAndTheTrialIsStillAFailedOne) {
  FaultyStore journal(0.0, 0);
  SimulatedExecutor executor(disk, {.workers = 3});
  TakesNoFailure optimizer;
  const auto run =
      run_optimizer(optimizer, answer_target, executor, &journal, options(Then::recover));
  EXPECT_EQ(run.end, RunEnd::converged);
  EXPECT_EQ(optimizer.residuals(), std::set<std::size_t>{3});
  int failed = 0;
  for (const Step& step : run.steps) {
    if (step.outcome) continue;
    ++failed;
    ASSERT_TRUE(step.answer);
    EXPECT_EQ(step.answer->value, 5.0);
    double sum = 0.0;
    for (const double r : step.answer->residuals) sum += r * r;
    EXPECT_NEAR(sum, 5.0, 1e-14);
  }
  EXPECT_GT(failed, 3);
  int stored = 0;
  journal.for_each([&](const Trial& trial) { stored += !trial.outcome.result; });
  EXPECT_GE(stored, failed);
  ASSERT_TRUE(run.best());
  EXPECT_TRUE(run.best()->outcome.ok());
}

TEST(Recover, AFailedPointFulfillsNoConstraint) {
  const Score constrained{
      .value = 2.0, .residuals = {}, .constraints = {-1.0, -1.0}, .equations = {0.0}};
  const auto answer = recovered({.then = Then::recover}, {{{{0.5}}, constrained}});
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->constraints, (std::vector<double>{1.0, 1.0}));
  EXPECT_EQ(violation(*answer), 1.0);
}

TEST(Recover, BeforeAnythingSucceededAFailureIsAFailure) {
  EXPECT_FALSE(recovered({.then = Then::recover}, {{{{0.5}}, Failure{"no"}}}));
}

// The model fails beyond 0.7. Between the success s = 0.25 and the failure t = 1, the midpoint
// 0.625 succeeds, 0.8125 and 0.71875 fail, and 0.671875 succeeds.
TEST(Continuation, HalvesTheWayFromTheNearestSuccessToTheFailedPoint) {
  const FailurePolicy policy{
      .then = Then::continuation, .halvings = 4, .space = DesignSpace({{.name = "x"}})};
  const std::vector<Step> before{
      {{{0.0}}, Score{0.0}}, {{{0.25}}, Score{0.25}}, {{{0.75}}, Failure{"no"}}};
  std::vector<double> asked;
  Result<Score> outcome = Score{};
  const auto continuation =
      continued(policy, before, {{1.0}}, std::nullopt, [&](std::span<const DesignPoint> wanted) {
        EXPECT_EQ(wanted.size(), 1u);
        const double x = wanted.front().values[0];
        asked.push_back(x);
        outcome = x > 0.7 ? Result<Score>(Failure{"no"}) : Result<Score>(Score{x});
        return &outcome;
      });
  EXPECT_EQ(asked, (std::vector<double>{0.625, 0.8125, 0.71875, 0.671875}));
  ASSERT_TRUE(continuation && continuation->answer);
  EXPECT_EQ(continuation->answer->value, 0.671875);
  EXPECT_EQ(continuation->steps.size(), 4u);
}

TEST(Continuation, TheFailureStandsWhereNothingOnTheWaySucceeds) {
  const FailurePolicy policy{.then = Then::continuation, .space = DesignSpace({{.name = "x"}})};
  const Result<Score> no = Failure{"no"};
  const Ask never = [&](std::span<const DesignPoint>) { return &no; };
  const auto none = continued(policy, {}, {{1.0}}, std::nullopt, never);
  ASSERT_TRUE(none);
  EXPECT_TRUE(none->steps.empty() && !none->answer);
  const auto all = continued(policy, {{{{0.0}}, Score{}}}, {{1.0}}, std::nullopt, never);
  ASSERT_TRUE(all);
  EXPECT_EQ(std::ssize(all->steps), policy.halvings);
  EXPECT_FALSE(all->answer);
}

TEST(Continuation, ItsTrialsAreInTheJournalAndItsAnswerComesFromTheEdge) {
  FaultyStore journal(0.0, 0);
  SimulatedExecutor executor(disk, {});
  Gss gss(answer_space());
  const auto run =
      run_optimizer(gss, answer_target, executor, &journal, options(Then::continuation));
  EXPECT_EQ(journal.size(), std::ssize(run.steps));  // with one worker no trial is speculative
  int answered = 0;
  for (std::size_t i = 0; i < run.steps.size(); ++i) {
    if (!run.steps[i].answer) continue;
    ++answered;
    double closest = 1.0;  // least distance of the earlier trials to the edge of failure
    for (std::size_t k = i - 6; k < i; ++k) {
      const std::vector<double>& x = run.steps[k].point.values;
      closest = std::min(closest, std::abs(std::hypot(x[0] - 0.5, x[1] - 0.5) - kRadius));
    }
    EXPECT_LT(closest, std::sqrt(2.0) / 64.0);
  }
  EXPECT_GT(answered, 3);
}

class FailureAnswer : public testing::TestWithParam<Then> {};

TEST_P(FailureAnswer, IsTheSameBitsForAnyNumberOfWorkersAndInAReplay) {
  const auto run_with = [&](const SimulatedOptions& simulated, TrialStore* journal) {
    SimulatedExecutor executor(disk, simulated);
    Gss gss(answer_space());
    return bits(run_optimizer(gss, answer_target, executor, journal, options(GetParam())));
  };
  const std::string reference = run_with({}, nullptr);
  for (const int workers : {1, 2, 3, 5, 8}) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      EXPECT_EQ(run_with({.workers = workers, .seed = seed}, nullptr), reference) << workers;
    }
  }
  FaultyStore journal(0.0, 0);
  EXPECT_EQ(run_with({.workers = 4}, &journal), reference);
  Gss gss(answer_space());
  EXPECT_EQ(bits(replay(gss, answer_target, journal, 1000, options(GetParam()).on_failure)),
            reference);
}

TEST_P(FailureAnswer, IsTheSameBitsAfterInterruptionsAnywhere) {
  SimulatedExecutor whole(disk, {});
  Gss undisturbed(answer_space());
  const std::string reference =
      bits(run_optimizer(undisturbed, answer_target, whole, nullptr, options(GetParam())));
  for (std::uint64_t history = 0; history < 10; ++history) {
    FaultyStore journal(0.0, 0);
    RandomStream random(11, history);
    for (bool finished = false; !finished;) {
      SimulatedExecutor executor(disk, {.workers = 1 + static_cast<int>(random.below(5))});
      const long trials = static_cast<long>(random.below(25));
      RunOptions interrupted = options(GetParam());
      interrupted.stop_patience = 0.0;
      interrupted.stop_requested = [&] { return executor.started() > trials; };
      Gss gss(answer_space());
      const auto run = run_optimizer(gss, answer_target, executor, &journal, interrupted);
      finished = run.end == RunEnd::converged;
      if (finished) {
        EXPECT_EQ(bits(run), reference) << "history " << history;
      }
    }
    EXPECT_EQ(journal.repeated(), 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Policies,
                         FailureAnswer,
                         testing::Values(Then::recover, Then::continuation, Then::proceed));

}  // namespace
}  // namespace latsch
