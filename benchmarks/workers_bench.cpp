// SPDX-License-Identifier: Apache-2.0
// Trials per second with two worker processes compared with one, for the finite-element tire B.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "base/scratch_folder_testing.h"
#include "correlation/study/study.h"
#include "evaluation/executors/process_executor.h"
#include "evaluation/schedule/scheduler.h"
#include "fit_study.h"
#include "optimization/design/full_factorial.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

constexpr double kReach = 1.8;
// the faster round counts, because other programs can only slow a round down
constexpr int kRounds = 2;

/// Lets every worker do one trial, so that reading the study and the symbolic factorization are not
/// part of the measured time.
void warm_up(Executor& executor, const DesignPoint& point) {
  const int workers = executor.workers();
  for (int i = 0; i < workers; ++i) executor.start(point);
  while (executor.idle() < workers) executor.wait(1.0);
}

double trials_a_second(const correlation::Study& study, int workers, const Options& options) {
  const ScratchFolder folder;
  Journal journal = Journal::open(folder / "workers.latsch", correlation::identity(study));
  ProcessExecutor executor(
      {.arguments = {program().string(), "worker", std::filesystem::absolute(study.file).string()},
       .workers = workers,
       .timeout = study.run.timeout});
  const SamplingPlan plan =
      full_factorial(study.space.tightened(study.space.initial(), 0.2),
                     std::vector<int>(study.space.size(), options.size(2, 1)));
  warm_up(executor, study.space.initial());
  const auto start = std::chrono::steady_clock::now();
  (void)run_doe(plan, executor, journal);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  return static_cast<double>(plan.points.size()) / time.count();
}

int run(const Options& options) {
  Table table("workers", options);
  const correlation::Study study =
      options.is_smoke() ? fresh_twin("tire_b_twin", CoarseMesh{}) : study_of_folder("tire_b_twin");
  double one = 0.0;
  double two = 0.0;
  for (int round = 0; round < options.size(kRounds, 1); ++round) {
    one = std::max(one, trials_a_second(study, 1, options));
    two = std::max(two, trials_a_second(study, 2, options));
  }
  table.note("one worker", fmt::format("{:.3f} trials/s", one));
  table.full_row("two workers against one",
                 fmt::format("{:.3f} trials/s, {:.2f} x", two, two / one),
                 fmt::format(">= {} x", kReach),
                 two >= kReach * one);
  table.note("cores of this machine", fmt::format("{}", std::thread::hardware_concurrency()));
  return table.exit_code();
}

}  // namespace
}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  return latsch::benchmarks::run_benchmark(argc, argv, {}, latsch::benchmarks::run);
}
