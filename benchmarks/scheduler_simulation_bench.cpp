// SPDX-License-Identifier: Apache-2.0
// Runs 10,000 seeded searches in virtual time in which everything may go wrong, and checks the
// rules of the scheduler.
//
// Points hang or fail, workers die or stall, and in every third search some workers are lost before
// they begin; all sixteen combinations of these faults occur, with a timeout. Messages are late,
// overtake each other and arrive twice, the journal refuses to store, and the master dies and is
// started again with another number of workers, one to eight. In every second group of sixteen
// searches the timeout is so short that stalled workers exceed it too.
//
//   bench_scheduler_simulation [HISTORIES [FIRST_SEED]]    a printed seed repeats one search
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <string>

#include "evaluation/schedule/scheduler_history_testing.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

struct Counts {
  long histories = 0, restarts = 0, repeats = 0, evaluations = 0, expired = 0;
  std::map<std::string, long> wrong;  // number of searches that violate a rule, by the rule
  int most_starts_over = 0;           // most starts of one trial, minus (retries + 2)
};

void add(const History& history, Counts& counts) {
  ++counts.histories;
  counts.restarts += history.restarts - 1;
  counts.repeats += history.repeats;
  counts.evaluations += history.evaluations;
  counts.expired += history.expired;
  counts.most_starts_over =
      std::max(counts.most_starts_over, history.most_starts - faults_of(history.seed).retries - 2);
  if (history.wrong.empty()) return;
  ++counts.wrong[history.wrong];
  fmt::print(stderr, "seed {}: {}\n", history.seed, history.wrong);
}

/// Runs searches with 1, 2, 4 and 8 workers and 3 seeds of all faults except the death of the
/// master. Returns the number whose search path differs from the undisturbed one.
long count_other_bits(Undisturbed& reference) {
  const SearchProblem& problem = reference.problem();
  long differ = 0;
  for (const int workers : {1, 2, 4, 8}) {
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      FaultyStore store(0.0, seed);
      Faults faults = faults_of(15 + 32 * seed);  // all faults, with a long timeout
      faults.master = faults.store = 0.0;
      FaultyWorld world(problem.evaluator, workers, faults, store, seed);
      RunOptions options;
      options.commit_in_background = false;
      options.on_failure.retries = faults.retries;
      const auto optimizer = problem.optimizer();
      differ += bits_of(run_optimizer(*optimizer, problem.objective, world, &store, options)) !=
                reference.like(faults);
    }
  }
  return differ;
}

/// Returns the mean virtual time, s, of `searches` searches in which one of twenty trials stalls.
double time_with_stalls(const SearchProblem& problem,
                        int workers,
                        bool stop_unwanted,
                        int searches) {
  double time = 0.0;
  for (std::uint64_t seed = 0; seed < static_cast<std::uint64_t>(searches); ++seed) {
    FaultyStore store(0.0, seed);
    FaultyWorld world(problem.evaluator, workers, {.stall = 0.05}, store, seed);
    RunOptions options;
    options.commit_in_background = false;
    options.stop_unwanted = stop_unwanted;
    const auto optimizer = problem.optimizer();
    (void)run_optimizer(*optimizer, problem.objective, world, &store, options);
    time += world.now();
  }
  return time / searches;
}

void stalls(Table& table, const SearchProblem& problem, int searches) {
  for (const int workers : {2, 4, 8}) {
    const double share = time_with_stalls(problem, workers, true, searches) /
                         time_with_stalls(problem, workers, false, searches);
    table.full_row(fmt::format("{} workers, 5 % stalls: time with unwanted ones stopped", workers),
                   fmt::format("{:.0f} %", 100.0 * share),
                   "< 100 %",
                   share < 1.0);
  }
}

int run(const Options& options) {
  const long histories = options.integer("HISTORIES", options.size(10'000, 64));
  const auto first_seed = static_cast<std::uint64_t>(options.integer("FIRST_SEED", 0));
  Table table("scheduler_simulation", options);
  Undisturbed reference(two_variable_search());
  Counts counts;
  for (long i = 0; i < histories; ++i) {
    add(live_through(reference, first_seed + static_cast<std::uint64_t>(i)), counts);
  }
  long wrong = 0;
  for (const auto& [what, number] : counts.wrong) wrong += number;
  table.note("histories", fmt::format("{}", counts.histories));
  table.note("evaluations kept; of these expired",
             fmt::format("{}; {}", counts.evaluations, counts.expired));
  table.note("restarts: the master died, the store refused", fmt::format("{}", counts.restarts));
  table.note("trials started again: lost workers, stragglers", fmt::format("{}", counts.repeats));
  const auto row = [&](const std::string& what, const std::string& reason) {
    table.row(
        what, fmt::format("{} histories", counts.wrong[reason]), "0", counts.wrong[reason] == 0);
  };
  row("do not come to their end", "the search does not come to its end");
  row("other bits than the undisturbed search", "other bits than undisturbed");
  table.row("a point started more than retries + 2 times",
            fmt::format("{} times more at most", counts.most_starts_over),
            "0",
            counts.most_starts_over <= 0);
  table.row("anything wrong, evaluations lost, repeated or seen before kept among it",
            fmt::format("{} histories", wrong),
            "0",
            wrong == 0);
  const long differ = count_other_bits(reference);
  table.row("1, 2, 4, 8 workers x 3 seeds: other bits",
            fmt::format("{} of 12", differ),
            "0",
            differ == 0);
  stalls(table, reference.problem(), options.size(200, 5));
  return table.exit_code();
}

}  // namespace
}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  return latsch::benchmarks::run_benchmark(
      argc,
      argv,
      {{"HISTORIES", "", "how many"}, {"FIRST_SEED", "", "of the first of them"}},
      latsch::benchmarks::run);
}
