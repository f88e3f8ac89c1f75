// SPDX-License-Identifier: Apache-2.0
// Test support: simulates one search in which workers, messages, store and master fail at random,
// from its first point to its end through every restart of the master, and checks the conditions
// that it has to fulfill.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "evaluation/schedule/faulty_world_testing.h"
#include "evaluation/schedule/scheduler.h"
#include "optimization/direct_search/gss.h"

namespace latsch {

/// Optimizer, evaluator and objective of a simulated search.
struct SearchProblem {
  std::function<std::unique_ptr<Optimizer>()> optimizer;
  Evaluator evaluator;
  Objective objective;
};

/// Returns a generating-set search for the minimum of a valley with a kink, in two variables.
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

/// Returns every point, value and failure of a trajectory, to the last bit.
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
  int workers = 0;       // number of workers in the last run
  int restarts = 0;      // number of restarts after the master died or the store refused
  long evaluations = 0;  // evaluations stored
  long repeats = 0;      // number of copies of stragglers and of repeated trials of lost workers
  long expired = 0;      // number of stored evaluations that exceeded their time limit
  int most_starts = 0;   // largest number of starts of one point in one run
  std::string wrong;     // the broken invariant; empty if all hold
  std::string bits;      // all bits of the trajectory
};

/// Wraps an optimizer and checks that every outcome it observes is in the store.
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

/// Returns the faults of a seed. The seeds go through all combinations of hanging points, lost
/// workers, stalls and failing points; the shares of all other faults are random, from none to
/// many.
inline Faults faults_of(std::uint64_t seed) {
  RandomStream random(seed, 4);
  const auto in_mix = [&](int kind, double share) { return seed >> kind & 1 ? share : 0.0; };
  Faults faults;
  faults.hang = in_mix(0, 0.03);
  faults.death = in_mix(1, 0.2 * random.uniform());
  faults.stall = in_mix(2, 0.1 * random.uniform());
  faults.failure = in_mix(3, 0.05);
  faults.retries = static_cast<int>(random.below(4));
  faults.late = 0.5 * random.uniform();
  faults.twice = 0.3 * random.uniform();
  faults.store = 0.03 * random.uniform();
  faults.master = 0.02 * random.uniform();
  // A stalled trial may also exceed its time limit. Chance then decides how a point ends, but the
  // outcome is fixed once it is stored.
  if (seed >> 4 & 1) faults.timeout = 0.2 + 3.0 * random.uniform();
  if (seed % 3 == 1) faults.refusal = 0.3 * random.uniform();
  return faults;
}

/// True if these faults must leave the trajectory equal to that of the undisturbed search, to the
/// last bit.
inline bool is_comparable(const Faults& faults) {
  return faults.stall == 0.0 || faults.timeout > 0.15 * FaultyWorld::kStall;
}

/// Returns the trajectory of a search with one worker in which points hang and fail but nothing
/// else goes wrong.
inline std::string undisturbed(const SearchProblem& problem, const Faults& faults) {
  FaultyStore store(0.0, 0);
  FaultyWorld world(
      problem.evaluator, 1, {.failure = faults.failure, .hang = faults.hang}, store, 0);
  RunOptions options;
  options.commit_in_background = false;
  const auto optimizer = problem.optimizer();
  return bits_of(run_optimizer(*optimizer, problem.objective, world, &store, options));
}

/// Cache of the undisturbed trajectories, each computed once.
class Undisturbed {
 public:
  explicit Undisturbed(SearchProblem problem) : problem_(std::move(problem)) {}
  const SearchProblem& problem() const { return problem_; }
  const std::string& like(const Faults& faults) {
    std::string& bits = bits_[{faults.hang > 0.0, faults.failure > 0.0}];
    if (bits.empty()) bits = undisturbed(problem_, faults);
    return bits;
  }

 private:
  SearchProblem problem_;
  std::map<std::pair<bool, bool>, std::string> bits_;
};

/// Returns the first violated condition of a completed search, in words; empty if there is none.
inline std::string fault_of(const History& history,
                            const Faults& faults,
                            const FaultyStore& store,
                            Undisturbed& reference) {
  const auto optimizer = reference.problem().optimizer();
  if (bits_of(replay(*optimizer, reference.problem().objective, store)) != history.bits) {
    return "the store tells another search";
  }
  if (is_comparable(faults) && history.bits != reference.like(faults)) {
    return "other bits than undisturbed";
  }
  return "";
}

inline History live_through(Undisturbed& reference, std::uint64_t seed) {
  const SearchProblem& problem = reference.problem();
  History history;
  history.seed = seed;
  const Faults faults = faults_of(seed);
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
    options.on_failure.retries = faults.retries;
    long repeats = 0;
    options.on_progress = [&](const RunProgress& p) { repeats = p.repeated + p.copied; };
    const long before = store.size();
    try {
      history.bits = bits_of(run_optimizer(optimizer, problem.objective, world, &store, options));
      history.wrong = fault_of(history, faults, store, reference);
    } catch (const MasterDied&) {
    } catch (const JournalError&) {
    } catch (const std::runtime_error& error) {
      history.wrong = error.what();
    }
    history.repeats += repeats;
    history.most_starts = std::max(history.most_starts, world.most_starts());
    if (world.most_starts() > faults.retries + 2) {
      history.wrong = "a point was started " + std::to_string(world.most_starts()) + " times, " +
                      std::to_string(faults.retries) + " retries allowed";
    }
    if (store.size() < before) history.wrong = "a kept evaluation was lost";
    if (store.repeated() > 0) history.wrong = "an evaluation was kept twice";
    if (world.started_again() > 0) history.wrong = "a kept evaluation was repeated";
    if (optimizer.unkept() > 0) history.wrong = "the optimizer saw what was not kept";
    if (history.restarts > 1000) history.wrong = "the search does not come to its end";
  }
  history.evaluations = store.size();
  store.for_each([&](const Trial& trial) {
    const auto& result = trial.outcome.result;
    history.expired += !result && result.failure().cause == Cause::timeout;
  });
  return history;
}

}  // namespace latsch
