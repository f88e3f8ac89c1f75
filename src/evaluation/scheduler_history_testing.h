// SPDX-License-Identifier: Apache-2.0
// For tests: one history of a search in a faulty world, from its first point to its end through
// every death of the master, and what it has to fulfill.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "evaluation/faulty_world_testing.h"
#include "evaluation/scheduler.h"
#include "optimization/gss.h"

namespace latsch {

/// A search to put through it.
struct SearchProblem {
  std::function<std::unique_ptr<Optimizer>()> optimizer;
  Evaluator evaluator;
  Objective objective;
};

/// A generating-set search for the lowest point of a kinked valley.
inline SearchProblem two_variable_search() {
  const DesignSpace space({{.name = "a", .lower = 0.0, .upper = 1.0, .initial = 0.9},
                           {.name = "b", .lower = 0.0, .upper = 1.0, .initial = 0.1}});
  return {[space] { return std::make_unique<Gss>(space); },
          [](const DesignPoint& point) -> Result<Channels> {
            Channels channels;
            channels.add({"y", "1", point.values});
            return channels;
          },
          [](const Channels& channels) -> Result<Score> {
            const std::vector<double>& y = channels["y"];
            return Score{std::abs(y[0] - 0.3) + std::hypot(y[0] + y[1] - 1.0, 0.1)};
          }};
}

/// Every point, value and failure of a trajectory, to the last bit.
inline std::string bits_of(const Run& run) {
  std::string bits = std::to_string(static_cast<int>(run.end));
  for (const Step& step : run.steps) {
    bits += step.point.bits();
    bits += step.outcome ? DesignPoint{{step.outcome->value}}.bits() : "failed";
  }
  return bits;
}

struct History {
  std::uint64_t seed = 0;
  int workers = 0;       // of the last run
  int restarts = 0;      // after the master died or the store refused
  long evaluations = 0;  // kept
  long repeats = 0;      // copies of stragglers, trials of lost workers
  std::string wrong;     // empty where every invariant holds
  std::string bits;      // of the trajectory
};

/// Observes as the optimizer does and asks whether what it is told is in the store.
class Witness : public Optimizer {
 public:
  Witness(std::unique_ptr<Optimizer> optimizer, const FaultyStore& store)
      : optimizer_(std::move(optimizer)), store_(store) {}
  std::vector<DesignPoint> propose(int count) const override { return optimizer_->propose(count); }
  void observe(const DesignPoint& point, const Result<Score>& outcome) override {
    unkept_ += !store_.has(point);
    optimizer_->observe(point, outcome);
  }
  bool converged() const override { return optimizer_->converged(); }
  long unkept() const { return unkept_; }

 private:
  std::unique_ptr<Optimizer> optimizer_;
  const FaultyStore& store_;
  long unkept_ = 0;
};

/// Every fault with a share of its own, from none to many.
inline Faults faults_of(std::uint64_t seed, double failure) {
  RandomStream random(seed, 4);
  Faults faults{.failure = failure};
  faults.death = 0.2 * random.uniform();
  faults.stall = 0.1 * random.uniform();
  faults.late = 0.5 * random.uniform();
  faults.twice = 0.3 * random.uniform();
  faults.store = 0.03 * random.uniform();
  faults.master = 0.02 * random.uniform();
  return faults;
}

inline History live_through(const SearchProblem& problem, std::uint64_t seed, double failure) {
  History history;
  history.seed = seed;
  const Faults faults = faults_of(seed, failure);
  RandomStream random(seed, 5);
  FaultyStore store(faults.store, seed);
  while (history.bits.empty() && history.wrong.empty()) {
    history.workers = 1 + static_cast<int>(random.below(8));
    FaultyWorld world(problem.evaluator,
                      history.workers,
                      faults,
                      store,
                      seed + (std::uint64_t{1} << 32) * ++history.restarts);
    Witness optimizer(problem.optimizer(), store);
    RunOptions options;
    options.commit_in_background = false;
    long repeats = 0;
    options.on_progress = [&](const RunProgress& progress) { repeats = progress.repeated; };
    const long before = store.size();
    try {
      const Run run = run_optimizer(optimizer, problem.objective, world, &store, options);
      history.bits = bits_of(run);
    } catch (const MasterDied&) {
    } catch (const JournalError&) {
    }
    history.repeats += repeats;
    if (store.size() < before) history.wrong = "a kept evaluation was lost";
    if (store.repeated() > 0) history.wrong = "an evaluation was kept twice";
    if (world.started_again() > 0) history.wrong = "a kept evaluation was repeated";
    if (optimizer.unkept() > 0) history.wrong = "the optimizer saw what was not kept";
    if (history.restarts > 1000) history.wrong = "the search does not come to its end";
  }
  history.evaluations = store.size();
  return history;
}

/// The trajectory of one worker in a world without faults.
inline std::string undisturbed(const SearchProblem& problem, double failure) {
  FaultyStore store(0.0, 0);
  FaultyWorld world(problem.evaluator, 1, {.failure = failure}, store, 0);
  RunOptions options;
  options.commit_in_background = false;
  const auto optimizer = problem.optimizer();
  return bits_of(run_optimizer(*optimizer, problem.objective, world, &store, options));
}

}  // namespace latsch
