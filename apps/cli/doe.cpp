// SPDX-License-Identifier: Apache-2.0
// latsch doe: a full factorial design over the worker processes, all channels kept in the journal.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "cli/interrupt.h"
#include "cli/tables.h"
#include "cli/trials.h"
#include "cli/verbs.h"
#include "correlation/tire_trials.h"
#include "optimization/full_factorial.h"

namespace latsch::cli {
namespace {

using correlation::Study;

constexpr size_t kShownPoints = 5;

std::vector<int> levels_of(const Study& study, int levels) {
  if (levels > 0) return std::vector<int>(study.space.size(), levels);
  if (study.doe_levels.empty()) {
    throw InputError(study.file.string() +
                     " has no [doe]; add levels = {NAME = 5, ...}, or say --levels 5");
  }
  return study.doe_levels;
}

struct Rated {
  DesignPoint point;
  double target;
};

/// The points of the plan that gave a target, least first.
std::vector<Rated> rated(const Study& study, const SamplingPlan& plan, const Journal& journal) {
  const Objective target = correlation::objective(study);
  std::map<std::string, Result<Score>> scores;
  journal.for_each([&](const Trial& trial) {
    if (trial.outcome.result) {
      scores.emplace(trial.point.bits(), target(*trial.outcome.result));
    }
  });
  std::vector<Rated> points;
  for (const DesignPoint& point : plan.points) {
    const auto score = scores.find(point.bits());
    if (score != scores.end() && score->second) points.push_back({point, score->second->value});
  }
  std::stable_sort(points.begin(), points.end(), [](const Rated& a, const Rated& b) {
    return a.target < b.target;
  });
  return points;
}

int doe(const std::string& file, int levels, int workers) {
  Study study = correlation::read_study(file);
  if (workers > 0) study.run.workers = workers;
  const SamplingPlan plan = full_factorial(study.space, levels_of(study, levels));
  Journal journal = Journal::open(study.run.journal, correlation::identity(study));
  fmt::print("{} points, {} finished trials in {}\n",
             plan.points.size(),
             journal.size(),
             study.run.journal.string());

  catch_interrupts();
  ProcessExecutor executor(worker_processes(study));
  if (run_doe(plan, executor, journal, run_options(study, /*length_known=*/true)) ==
      RunEnd::stopped) {
    fmt::print("Interrupted; {} trials are safe. The same command goes on.\n", journal.size());
    return kFailed;
  }
  const auto points = rated(study, plan, journal);
  fmt::print("\n{} of {} points succeeded; the best:\n", points.size(), plan.points.size());
  if (points.empty()) return kFailed;
  for (size_t i = 0; i < std::min(kShownPoints, points.size()); ++i) {
    fmt::print("target {:.4f} %\n", points[i].target * 100.0);
    print_point(study.space, points[i].point);
  }
  return write_report(study, journal);
}

}  // namespace

void add_doe(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand(
      "doe", "Evaluates a full factorial grid: sees local minima, chooses where to start");
  verb->footer(
      "Example:\n  latsch doe studies/tire_b_twin/study.toml --levels 5 --workers 2\n\n"
      "A later `latsch run` of the same study reuses what the grid evaluated.");
  auto file = std::make_shared<std::string>();
  auto levels = std::make_shared<int>(0);
  auto workers = std::make_shared<int>(0);
  verb->add_option("study", *file, "Study file (TOML)")->required();
  verb->add_option("--levels", *levels, "Values of every variable, instead of the study's [doe]")
      ->check(CLI::Range(2, 1000));
  verb->add_option("--workers", *workers, "Worker processes, instead of the study's")
      ->check(CLI::Range(1, 1024));
  verb->callback([=, &exit_code] { exit_code = doe(*file, *levels, *workers); });
}

}  // namespace latsch::cli
