// SPDX-License-Identifier: Apache-2.0
#include "evaluation/schedule/scheduler.h"

#include <fmt/format.h>

#include <functional>
#include <utility>

#include "evaluation/schedule/dispatcher.h"
#include "evaluation/schedule/look_ahead.h"

namespace latsch {
namespace {

/// Runs an optimizer: repeatedly obtains the outcome of the first point that it proposes and passes
/// it to the optimizer.
class Search {
 public:
  using Seen = std::function<void(const Step&)>;
  using Propose = std::function<std::vector<DesignPoint>(const Optimizer&)>;

  Search(Optimizer& optimizer, const FailurePolicy& policy, Propose propose, Ask ask, Seen seen)
      : optimizer_(optimizer),
        policy_(policy),
        propose_(std::move(propose)),
        ask_(std::move(ask)),
        seen_(std::move(seen)) {}

  Run to_its_end(long max_steps) {
    while (!optimizer_.converged()) {
      if (std::ssize(run_.steps) >= max_steps) return ended(RunEnd::max_steps);
      const std::vector<DesignPoint> plan = propose_(optimizer_);
      const Result<Score>* outcome = ask_(plan);
      if (!outcome) return ended(RunEnd::stopped);
      Step step{plan.front(), *outcome};
      if (!step.outcome && !answer(step, plan)) return ended(RunEnd::stopped);
      const bool failed = !step.outcome;
      observe(std::move(step));
      if (failed && policy_.then == FailurePolicy::Then::abort) return ended(RunEnd::aborted);
    }
    return ended(RunEnd::converged);
  }

 private:
  /// Sets the value that the optimizer receives for the failed point. Returns false if a trial
  /// needed for this value cannot be obtained.
  bool answer(Step& failed, std::span<const DesignPoint> plan) {
    if (policy_.then == FailurePolicy::Then::recover) {
      failed.answer = recovered(policy_, run_.steps);
    }
    if (policy_.then != FailurePolicy::Then::continuation) return true;
    std::optional<std::span<const DesignPoint>> behind;
    if (plan.size() > 1) behind = plan.subspan(1);
    auto continuation = continued(policy_, run_.steps, failed.point, behind, ask_);
    if (!continuation) return false;
    for (Step& step : continuation->steps) observe(std::move(step));
    failed.answer = std::move(continuation->answer);
    return true;
  }

  void observe(Step step) {
    optimizer_.observe(step.point, step.answer ? Result<Score>(*step.answer) : step.outcome);
    seen_(step);
    run_.steps.push_back(std::move(step));
  }

  std::string in_words(RunEnd end) const {
    switch (end) {
      case RunEnd::converged: {
        const std::string why = optimizer_.ending();
        return why.empty() ? "where its steps are as short as its tolerance" : why;
      }
      case RunEnd::max_steps:
        return "before it had converged: max_steps is reached" + promised() + found() +
               "; with more steps it continues from here";
      case RunEnd::aborted:
        return "with a trial that failed, as on_failure = \"abort\" requires";
      case RunEnd::stopped:
        return {};
    }
    return {};
  }

  /// Returns what the next step of a search that is stopped early promises; empty if that is not
  /// known.
  std::string promised() const {
    const auto share = optimizer_.promise();
    if (!share) return "";
    return fmt::format(
        ", and the next step promises to lower the value that it minimizes by {:.2g} %",
        100.0 * *share);
  }

  /// Returns the minima that a search for several ones has found by now.
  std::string found() const {
    const std::string basins = optimizer_.basins_in_words();
    return basins.empty() ? "" : "; so far " + basins;
  }

  /// Returns the claims of the end: those of the optimizer or, for a search that is stopped early,
  /// why it was stopped and what its next step promises.
  std::vector<EndingClaim> claims(RunEnd end) const {
    if (end == RunEnd::converged) return optimizer_.claims();
    if (end == RunEnd::stopped) return {};
    EndingClaim early{.statement = "stopped early", .test = in_words(end)};
    early.numbers.push_back(
        {.name = "steps", .value = static_cast<double>(std::ssize(run_.steps))});
    if (const auto share = optimizer_.promise())
      early.numbers.push_back({.name = "promised fall", .value = *share, .unit = "of the value"});
    return {early};
  }

  Run ended(RunEnd end) {
    run_.end = end;
    run_.ending = in_words(end);
    run_.claims = claims(end);
    run_.basins = optimizer_.basins();
    return std::move(run_);
  }

  Optimizer& optimizer_;
  const FailurePolicy& policy_;
  Propose propose_;
  Ask ask_;
  Seen seen_;
  Run run_;
};

}  // namespace

const Step* Run::best() const {
  const Step* best = nullptr;
  for (const Step& step : steps) {
    if (step.outcome && (!best || is_better(*step.outcome, *best->outcome))) best = &step;
  }
  return best;
}

Run run_optimizer(Optimizer& optimizer,
                  const Objective& objective,
                  Executor& executor,
                  TrialStore* journal,
                  const RunOptions& options) {
  Dispatcher dispatcher(objective, executor, journal, options, options.max_steps);
  // A single worker needs no speculative points.
  LookAhead ahead(executor.workers() > 1 ? executor.workers() * options.look_ahead : 1);
  Search search(
      optimizer,
      options.on_failure,
      [&](const Optimizer& thinking) {
        // While the outcome of the next point is already known, from the journal or from
        // speculation, no speculative points are computed.
        std::vector<DesignPoint> plan = thinking.propose(1);
        if (dispatcher.knows(plan.front())) return plan;
        const double since = executor.now();
        const int points = ahead.points(dispatcher.trial_time());
        if (points > 1) plan = thinking.propose(points);
        ahead.took(points, executor.now() - since);
        return plan;
      },
      [&](std::span<const DesignPoint> wanted) { return dispatcher.first_of(wanted); },
      [&](const Step& step) { dispatcher.count(step.point, step.outcome, true); });
  Run run = search.to_its_end(options.max_steps);
  dispatcher.finish();  // withdraws speculation that is no longer needed
  dispatcher.report();
  return run;
}

Run replay(Optimizer& optimizer,
           const Objective& objective,
           const TrialStore& journal,
           long max_steps,
           const FailurePolicy& on_failure) {
  KnownScores known(objective);
  journal.for_each([&](const Trial& trial) { known.add_kept(trial); });
  Search search(
      optimizer,
      on_failure,
      [](const Optimizer& thinking) { return thinking.propose(1); },
      [&](std::span<const DesignPoint> wanted) { return known.find(wanted.front()); },
      [](const Step&) {});
  return search.to_its_end(max_steps);
}

RunEnd run_doe(const SamplingPlan& plan,
               Executor& executor,
               TrialStore& journal,
               const RunOptions& options) {
  const Objective none;
  Dispatcher dispatcher(none, executor, &journal, options, std::ssize(plan.points));
  RunEnd end = RunEnd::stopped;
  const auto known = [&](const DesignPoint& point, const Result<Score>& outcome) {
    dispatcher.count(point, outcome, false);
    if (!outcome && options.on_failure.then == FailurePolicy::Then::abort) end = RunEnd::aborted;
    return end != RunEnd::aborted;
  };
  if (dispatcher.all_of(plan.points, known)) end = RunEnd::converged;
  dispatcher.finish();
  dispatcher.report();
  return end;
}

}  // namespace latsch
