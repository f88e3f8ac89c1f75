// SPDX-License-Identifier: Apache-2.0
// 10,000 seeded histories of a search in virtual time in which everything goes wrong that may
//
// Workers die or stall, messages are late, overtake each other and come twice, the store refuses,
// the master dies and is started again with another number of workers.
//
//   bench_scheduler_simulation [HISTORIES [FIRST_SEED]]    a seed that was printed is one history
#include <fmt/format.h>

#include <cstdlib>
#include <string>

#include "evaluation/scheduler_history_testing.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

constexpr double kFailure = 0.05;  // of the points, the same ones in every history

struct Counts {
  long histories = 0, restarts = 0, repeats = 0, evaluations = 0;
  long broken = 0;  // an invariant does not hold
  long differ = 0;  // other bits than the undisturbed search
};

void add(const History& history, const std::string& reference, Counts& counts) {
  ++counts.histories;
  counts.restarts += history.restarts - 1;
  counts.repeats += history.repeats;
  counts.evaluations += history.evaluations;
  if (!history.wrong.empty()) {
    ++counts.broken;
    fmt::print(stderr, "seed {}: {}\n", history.seed, history.wrong);
  } else if (history.bits != reference) {
    ++counts.differ;
    fmt::print(stderr, "seed {}: other bits than undisturbed\n", history.seed);
  }
}

/// 1, 2, 4, 8 workers x 3 seeds of the faults, the master never dies: how many trajectories differ.
long count_other_bits(const SearchProblem& problem, const std::string& reference) {
  long differ = 0;
  for (const int workers : {1, 2, 4, 8}) {
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      FaultyStore store(0.0, seed);
      Faults faults = faults_of(seed, kFailure);
      faults.master = 0.0;
      FaultyWorld world(problem.evaluator, workers, faults, store, seed);
      RunOptions options;
      options.commit_in_background = false;
      const auto optimizer = problem.optimizer();
      differ += bits_of(run_optimizer(*optimizer, problem.objective, world, &store, options)) !=
                reference;
    }
  }
  return differ;
}

/// s in virtual time, mean of so many searches in which one trial of twenty stalls.
double time_with_stalls(const SearchProblem& problem, int workers, bool stop_unwanted) {
  constexpr int kSearches = 200;
  double time = 0.0;
  for (std::uint64_t seed = 0; seed < kSearches; ++seed) {
    FaultyStore store(0.0, seed);
    FaultyWorld world(problem.evaluator, workers, {.stall = 0.05}, store, seed);
    RunOptions options;
    options.commit_in_background = false;
    options.stop_unwanted = stop_unwanted;
    const auto optimizer = problem.optimizer();
    (void)run_optimizer(*optimizer, problem.objective, world, &store, options);
    time += world.now();
  }
  return time / kSearches;
}

void stalls(Table& table, const SearchProblem& problem) {
  for (const int workers : {2, 4, 8}) {
    const double share =
        time_with_stalls(problem, workers, true) / time_with_stalls(problem, workers, false);
    table.row(fmt::format("{} workers, 5 % stalls: time with unwanted ones stopped", workers),
              fmt::format("{:.0f} %", 100.0 * share),
              "< 100 %",
              share < 1.0);
  }
}

int run(long histories, std::uint64_t first_seed) {
  Table table("scheduler_simulation");
  const SearchProblem problem = two_variable_search();
  const std::string reference = undisturbed(problem, kFailure);
  Counts counts;
  for (long i = 0; i < histories; ++i) {
    add(live_through(problem, first_seed + static_cast<std::uint64_t>(i), kFailure),
        reference,
        counts);
  }
  table.note("histories", fmt::format("{}", counts.histories));
  table.note("evaluations kept", fmt::format("{}", counts.evaluations));
  table.note("restarts: the master died, the store refused", fmt::format("{}", counts.restarts));
  table.note("trials started again: lost workers, stragglers", fmt::format("{}", counts.repeats));
  table.row("evaluations lost, repeated or seen before kept",
            fmt::format("{} histories", counts.broken),
            "0",
            counts.broken == 0);
  table.row("other bits than the undisturbed search",
            fmt::format("{} histories", counts.differ),
            "0",
            counts.differ == 0);
  const long differ = count_other_bits(problem, reference);
  table.row("1, 2, 4, 8 workers x 3 seeds: other bits",
            fmt::format("{} of 12", differ),
            "0",
            differ == 0);
  stalls(table, problem);
  return table.exit_code();
}

}  // namespace
}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  const long histories = argc > 1 ? std::atol(argv[1]) : 10'000;
  const std::uint64_t first_seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 0;
  return latsch::benchmarks::guarded(
      [&] { return latsch::benchmarks::run(histories, first_seed); });
}
