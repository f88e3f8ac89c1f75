// SPDX-License-Identifier: Apache-2.0
// Time that an evaluation takes in addition to the model: in this process, in a worker process, and
// with its entry in the journal. Times are the least of five repetitions, because other work on the
// machine slows some of them down.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "base/scratch_folder_testing.h"
#include "evaluation/executors/inline_executor.h"
#include "evaluation/executors/process_executor.h"
#include "evaluation/executors/worker.h"
#include "evaluation/schedule/scheduler.h"
#include "optimization/design/full_factorial.h"
#include "optimization/direct_search/gss.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

// A model that returns as many channels as a trial of a tire study: forces and frequencies.
Result<Channels> model(const DesignPoint& point) {
  Channels channels;
  channels.add({"stiffness/Fz", "N", std::vector<double>(5, point.values[0])});
  channels.add({"modes/frequency", "Hz", std::vector<double>(12, point.values[1])});
  channels.add({"modes/shapes", "1", std::vector<double>(12 * 90, point.values[2])});
  return channels;
}

Result<Score> target(const Channels& channels) {
  const double a = channels["stiffness/Fz"][0] - 0.3;
  const double b = channels["modes/frequency"][0] - 0.6;
  const double c = channels["modes/shapes"][0] + a - 0.2;
  return Score{std::abs(a) + std::abs(a + b) + std::abs(c)};
}

DesignSpace space() {
  return DesignSpace({{.name = "a", .initial = 0.9}, {.name = "b", .initial = 0.1}, {.name = "c"}});
}

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double quickest(int passes, double (*time_of_a_pass)()) {
  double least = time_of_a_pass();
  for (int i = 1; i < passes; ++i) least = std::min(least, time_of_a_pass());
  return least;
}

double time_in_process() {
  constexpr int kRounds = 10;
  long steps = 0;
  const double start = now();
  for (int i = 0; i < kRounds; ++i) {
    InlineExecutor executor(model);
    Gss gss(space());
    steps += std::ssize(run_optimizer(gss, target, executor, nullptr).steps);
  }
  return (now() - start) / static_cast<double>(steps);
}

ProcessOptions workers(int count) {
  return {.arguments = {std::filesystem::read_symlink("/proc/self/exe").string(), "worker"},
          .workers = count};
}

double time_of_a_round_trip() {
  constexpr int kTrips = 2000;
  ProcessExecutor executor(workers(1));
  const auto trip = [&](double x) {
    executor.start({{x, 0.5, 0.5}});
    while (executor.wait(1.0).empty()) {
    }
  };
  trip(0.0);
  const double start = now();
  for (int i = 0; i < kTrips; ++i) trip(i);
  return (now() - start) / kTrips;
}

double time_with_journal() {
  const ScratchFolder folder;
  Journal journal = Journal::open(folder / "overhead.latsch", {{"model", "none"}});
  ProcessExecutor executor(workers(1));
  const SamplingPlan plan = full_factorial(space(), {10, 10, 5});
  const double start = now();
  (void)run_doe(plan, executor, journal);
  return (now() - start) / static_cast<double>(plan.points.size());
}

/// There is one worker, and each point is proposed only after the outcome before it is known, so
/// every step waits for the disk.
double time_of_a_step_with_journal() {
  const ScratchFolder folder;
  Journal journal = Journal::open(folder / "overhead.latsch", {{"model", "none"}});
  ProcessExecutor executor(workers(1));
  Gss gss(space());
  const double start = now();
  const Run run = run_optimizer(gss, target, executor, &journal);
  return (now() - start) / static_cast<double>(run.steps.size());
}

int run(const Options& options) {
  Table table("overhead", options);
  const int passes = options.size(5, 1);
  const double in_process = quickest(passes, time_in_process);
  table.full_row("search and scheduler in this process, an evaluation",
                 fmt::format("{:.1f} us", 1e6 * in_process),
                 "< 50 us",
                 in_process < 50e-6);
  const double external = quickest(passes, time_with_journal);
  table.full_row("evaluation in a worker, committed to the journal",
                 fmt::format("{:.2f} ms", 1e3 * external),
                 "< 3 ms",
                 external < 3e-3);
  const double step = quickest(passes, time_of_a_step_with_journal);
  table.full_row("step of a search in a worker, on the disk before the next",
                 fmt::format("{:.2f} ms", 1e3 * step),
                 "< 3 ms",
                 step < 3e-3);
  table.note("of this, to the worker and back",
             fmt::format("{:.1f} us", 1e6 * quickest(passes, time_of_a_round_trip)));
  return table.exit_code();
}

}  // namespace
}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  if (argc > 1 && std::strcmp(argv[1], "worker") == 0) {
    return latsch::serve(latsch::benchmarks::model);
  }
  return latsch::benchmarks::run_benchmark(argc, argv, {}, latsch::benchmarks::run);
}
