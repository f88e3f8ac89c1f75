// SPDX-License-Identifier: Apache-2.0
#include "evaluation/scheduler.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <span>
#include <string>
#include <unordered_map>
#include <unordered_set>

namespace latsch {
namespace {

constexpr double kPatience = 0.1;  // s between two looks at the stop request and the progress bar

/// The target function of an outcome; a score that is not a number is no score.
Result<Score> score(const Objective& objective, const Outcome& outcome) {
  if (!outcome.result) return outcome.result.failure();
  if (!objective) return Score{};
  Result<Score> result = objective(*outcome.result);
  if (result && !std::isfinite(result->value)) return Failure{"the target function is not finite"};
  return result;
}

/// Every outcome so far by the bits of its point, as scores: channels are large and stay on disk.
class KnownScores {
 public:
  explicit KnownScores(const Objective& objective) : objective_(objective) {}

  void add(const Trial& trial) {
    scores_.insert_or_assign(trial.point.bits(), score(objective_, trial.outcome));
  }

  const Result<Score>* find(const DesignPoint& point) const {
    const auto found = scores_.find(point.bits());
    return found == scores_.end() ? nullptr : &found->second;
  }

 private:
  const Objective& objective_;
  std::unordered_map<std::string, Result<Score>> scores_;
};

class Scheduler {
 public:
  Scheduler(const Objective& objective,
            Executor& executor,
            Journal* journal,
            const RunOptions& options,
            long planned)
      : executor_(executor), journal_(journal), options_(options), known_(objective) {
    if (journal_) journal_->for_each([&](const Trial& trial) { known_.add(trial); });
    progress_.planned = planned;
  }

  /// The outcome of the first point of the plan, keeping idle workers busy with the points behind
  /// it; nullptr where a stop was requested before it was known.
  const Result<Score>* first_of(std::span<const DesignPoint> plan) {
    while (true) {
      if (stop_requested()) {
        finish_running();
        return nullptr;
      }
      if (const Result<Score>* outcome = known_.find(plan.front())) return outcome;
      start_idle_workers(plan);
      receive(executor_.wait(kPatience));
      report();
    }
  }

  /// Tells the progress bar what the optimizer, or the plan, has seen so far.
  void count(const DesignPoint& point, const Result<Score>& outcome, bool is_score) {
    ++progress_.known;
    if (!is_score || !outcome) return;
    if (progress_.best && *progress_.best <= outcome->value) return;
    progress_.best = outcome->value;
    progress_.best_point = point;
  }

  void report() {
    if (!options_.on_progress) return;
    progress_.running = static_cast<int>(running_.size());
    progress_.elapsed = std::chrono::duration<double>(Steady::now() - start_).count();
    options_.on_progress(progress_);
  }

 private:
  using Steady = std::chrono::steady_clock;

  bool stop_requested() const { return options_.stop_requested && options_.stop_requested(); }

  void start_idle_workers(std::span<const DesignPoint> plan) {
    for (const DesignPoint& point : plan) {
      if (executor_.idle() == 0) return;
      if (known_.find(point) || running_.contains(point.bits())) continue;
      running_.insert(point.bits());
      executor_.start(point);
    }
  }

  /// On the disk first, then known.
  void receive(const std::vector<Trial>& trials) {
    for (const Trial& trial : trials) {
      if (journal_) journal_->append(trial);
      known_.add(trial);
      running_.erase(trial.point.bits());
      ++progress_.evaluated;
      if (!trial.outcome.result) ++progress_.failed;
      wall_time_ += trial.outcome.wall_time;
      progress_.trial_wall_time = wall_time_ / static_cast<double>(progress_.evaluated);
    }
  }

  /// Running trials get a moment to end; those that do not will be evaluated again on resume.
  void finish_running() {
    const auto until = Steady::now() + std::chrono::duration<double>(options_.stop_patience);
    while (!running_.empty() && Steady::now() < until) receive(executor_.wait(kPatience));
    executor_.abandon();
  }

  Executor& executor_;
  Journal* journal_;
  const RunOptions& options_;
  KnownScores known_;
  std::unordered_set<std::string> running_;  // bits of the points
  RunProgress progress_;
  double wall_time_ = 0.0;
  Steady::time_point start_ = Steady::now();
};

}  // namespace

const Step* Run::best() const {
  const Step* best = nullptr;
  for (const Step& step : steps) {
    if (step.outcome && (!best || step.outcome->value < best->outcome->value)) best = &step;
  }
  return best;
}

Run run_optimizer(Optimizer& optimizer,
                  const Objective& objective,
                  Executor& executor,
                  Journal* journal,
                  const RunOptions& options) {
  Scheduler scheduler(objective, executor, journal, options, options.max_steps);
  // One worker has no use for speculation.
  const int points = executor.workers() > 1 ? executor.workers() * options.look_ahead : 1;
  Run run;
  while (!optimizer.converged()) {
    if (std::ssize(run.steps) >= options.max_steps) {
      run.end = RunEnd::max_steps;
      break;
    }
    const std::vector<DesignPoint> plan = optimizer.propose(points);
    const Result<Score>* outcome = scheduler.first_of(plan);
    if (!outcome) return run;
    optimizer.observe(plan.front(), *outcome);
    run.steps.push_back({plan.front(), *outcome});
    scheduler.count(plan.front(), *outcome, true);
  }
  if (optimizer.converged()) run.end = RunEnd::converged;
  executor.abandon();  // speculation that is not needed any more
  scheduler.report();
  return run;
}

Run replay(Optimizer& optimizer,
           const Objective& objective,
           const Journal& journal,
           long max_steps) {
  KnownScores known(objective);
  journal.for_each([&](const Trial& trial) { known.add(trial); });
  Run run;
  while (!optimizer.converged() && std::ssize(run.steps) < max_steps) {
    const DesignPoint point = optimizer.propose(1).front();
    const Result<Score>* outcome = known.find(point);
    if (!outcome) return run;
    optimizer.observe(point, *outcome);
    run.steps.push_back({point, *outcome});
  }
  run.end = optimizer.converged() ? RunEnd::converged : RunEnd::max_steps;
  return run;
}

RunEnd run_doe(const SamplingPlan& plan,
               Executor& executor,
               Journal& journal,
               const RunOptions& options) {
  const Objective none;
  Scheduler scheduler(none, executor, &journal, options, std::ssize(plan.points));
  for (std::span<const DesignPoint> rest = plan.points; !rest.empty(); rest = rest.subspan(1)) {
    const Result<Score>* outcome = scheduler.first_of(rest);
    if (!outcome) return RunEnd::stopped;
    scheduler.count(rest.front(), *outcome, false);
  }
  scheduler.report();
  return RunEnd::converged;
}

}  // namespace latsch
