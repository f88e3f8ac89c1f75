// SPDX-License-Identifier: Apache-2.0
// The same with 16 simulated workers whose trials take 0.5 to 1.5 units of a virtual time
//
// Through the scheduler that runs studies. HOPSPACK 2.0 keeps 10.3 of 16 workers busy and solves
// .283/.566/.642 at 2/5/10 (n + 1) units.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "evaluation/executors/simulated_executor.h"
#include "evaluation/schedule/scheduler.h"
#include "more_wild_runs.h"
#include "optimization/trust_region/residual_trust_region.h"

namespace latsch::benchmarks {
namespace {

constexpr int kWorkers = 16;
constexpr int kOutstanding =
    20;  // a quarter more: no worker waits for the trial that is observed next
const std::vector<double> kTimes{2, 5, 10};  // of n + 1 mean trials

struct Busy {
  double work = 0.0, time = 0.0;
};

Result<Score> sum_of_squares(const Channels& channels) {
  Score score{0.0, channels["r"]};
  for (const double r : score.residuals) score.value += r * r;
  return score;
}

/// What the method has decided on, without speculation: no worker is left for that.
class Decided : public Optimizer {
 public:
  explicit Decided(Optimizer& method) : method_(method) {}
  std::vector<DesignPoint> propose(int count) const override {
    return method_.propose(std::min(count, kOutstanding));
  }
  void observe(const DesignPoint& point, const Result<Score>& outcome) override {
    method_.observe(point, outcome);
  }
  bool converged() const override { return method_.converged(); }

 private:
  Optimizer& method_;
};

Solved run(const more_wild::Problem& problem, Busy& busy) {
  Observed observed(problem, {});
  SimulatedExecutor* clock = nullptr;
  const auto evaluate = [&](const DesignPoint& point) -> Result<Channels> {
    Result<Score> score = observed.at_time(point.values, clock->now());
    if (!score) return score.failure();
    Channels channels;
    channels.add({"r", "1", score->residuals});
    return channels;
  };
  SimulatedExecutor executor(evaluate, {.workers = kWorkers, .seed = 1});
  clock = &executor;
  ResidualTrustRegion method(more_wild::space(problem),
                             {.initial_radius = 1.0 / more_wild::kBoxWidth,
                              .step_tolerance = 1e-12,
                              .outstanding = kOutstanding});
  RunOptions options;
  options.max_steps = 1'000'000;
  options.look_ahead = 2;
  const double end = kTimes.back() * (problem.n() + 1);
  options.stop_requested = [&] {
    return executor.now() >= end || (observed.is_done() && executor.now() >= 0.5 * end);
  };
  options.stop_patience = 0.0;
  Decided decided(method);
  run_optimizer(decided, sum_of_squares, executor, nullptr, options);
  busy.work += std::min(executor.busy_time(), kWorkers * executor.now());
  busy.time += executor.now();
  return observed.solved();
}

}  // namespace
}  // namespace latsch::benchmarks

namespace {

int bench() {
  using namespace latsch;
  using namespace latsch::benchmarks;
  Table table("more_wild_parallel");
  Busy busy;
  std::vector<Solved> solved;
  for (const more_wild::Problem& problem : more_wild::problems()) {
    solved.push_back(run(problem, busy));
  }
  const Profile trust = profile(solved, kTimes);
  reach(table, "16 workers, tau 1e-3 at 2 (n + 1)", trust.tau_1e3[0], 0.80);
  reach(table, "16 workers, tau 1e-3 at 10 (n + 1)", trust.tau_1e3[2], 0.95);
  const double mean = busy.work / busy.time;
  table.row("workers busy, of 16", fmt::format("{:.1f}", mean), ">= 14.5", mean >= 14.5);
  note(table, "16 workers", trust);
  return table.exit_code();
}

}  // namespace

int main() { return latsch::benchmarks::guarded(bench); }
