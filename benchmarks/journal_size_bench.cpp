// SPDX-License-Identifier: Apache-2.0
// Size of a journal relative to its numbers as plain doubles, and the time to write and to read it.
// The channels are those of real searches: a Magic Formula 6.1 with 600 measured states, fitted to
// a race tire and profiled; and flexible ring tires over a cleat, at points that cover the bounds
// of a study. Both are smooth functions to within the rounding of their sums, at states that
// contain measurement noise. Further channels have added noise, which stands for noise of a model
// itself: it cannot be predicted, so it is stored in full.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "base/random.h"
#include "base/scratch_folder_testing.h"
#include "correlation/analysis/identifiability.h"
#include "correlation/search/study_fit.h"
#include "correlation/target/study_trials.h"
#include "evaluation/executors/thread_executor.h"
#include "evaluation/trial/encoding.h"
#include "optimization/design/latin_hypercube.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

namespace fs = std::filesystem;

constexpr double kRipple = 1e-6;  // amplitude of the added noise, as a share of every value

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Returns the study with every second of its 1200 states.
correlation::Study magic_formula(const fs::path& folder) {
  const fs::path from = fs::path(LATSCH_SOURCE_DIR) / "studies" / "race_tire_mf";
  fs::copy(from, folder, fs::copy_options::recursive | fs::copy_options::overwrite_existing);
  std::ifstream all(from / "cornering.csv");
  std::ofstream half(folder / "cornering.csv");
  long row = 0;
  for (std::string line; std::getline(all, line);) {
    const bool is_head = line.starts_with('#') || row == 0;
    if (!line.starts_with('#')) ++row;
    if (is_head || row % 2 == 0) half << line << '\n';
  }
  half.close();
  correlation::Study study = correlation::read_study(folder / "study.toml", experiment::language());
  study.optimizer.method = "residual_trust_region";  // a search with many trials
  study.asks_slopes = false;
  return study;
}

/// Runs the fit of the study and its profiles, up to `most` trials in all.
std::vector<Trial> search(const correlation::Study& study, long most) {
  Journal journal = Journal::open(study.run.journal, correlation::identity(study));
  ThreadExecutor executor([&] { return correlation::evaluator(study); }, 2);
  RunOptions options{.max_steps = study.max_steps};
  options.stop_requested = [&] { return journal.size() >= most; };
  const auto fit = correlation::fit(study, executor, journal, options);
  if (const Step* best = fit.run.best(); best && fit.run.end != RunEnd::stopped) {
    (void)correlation::identify(
        study, best->point, correlation::Depth::profiles, executor, journal, options);
  }
  return journal.trials();
}

std::vector<Trial> rings(int count) {
  const auto study = correlation::read_study(
      fs::path(LATSCH_SOURCE_DIR) / "studies" / "cleat_fit" / "study.toml", experiment::language());
  const Evaluator model = correlation::evaluator(study);
  std::vector<Trial> trials;
  for (const DesignPoint& point : latin_hypercube(study.space, count).points) {
    trials.push_back({point, evaluate(model, point)});
  }
  return trials;
}

std::vector<Trial> with_ripple(std::vector<Trial> trials) {
  RandomStream random(1, 0);
  for (Trial& trial : trials) {
    if (!trial.outcome.result) continue;
    Channels rough;
    for (Channel channel : trial.outcome.result->all()) {
      for (double& x : channel.values) x *= 1.0 + kRipple * (random.uniform() - 0.5);
      rough.add(std::move(channel));
    }
    trial.outcome.result = std::move(rough);
  }
  return trials;
}

struct Cost {
  double share = 0.0;              // file size over the size of the plain doubles
  double write = 0.0, read = 0.0;  // s per trial
  double plain = 0.0;              // bytes per trial
  bool is_same = true;
};

Cost cost_of(const std::vector<Trial>& trials) {
  // number of trials that several workers commit to the journal together
  constexpr std::size_t kGroup = 16;
  const ScratchFolder folder;
  const fs::path file = folder / "a.latsch";
  Cost cost;
  const auto count = static_cast<double>(trials.size());
  double plain = 0.0;
  for (const Trial& trial : trials) plain += static_cast<double>(encode(trial.outcome).size());
  {
    Journal journal = Journal::open(file, {{"model", "none"}});
    const double start = now();
    for (std::size_t i = 0; i < trials.size(); i += kGroup) {
      journal.append(std::span(trials).subspan(i, std::min(kGroup, trials.size() - i)));
    }
    cost.write = (now() - start) / count;
  }
  const double start = now();
  std::size_t i = 0;
  Journal::read(file).for_each([&](const Trial& trial) {
    cost.is_same = cost.is_same && encode(trial.outcome) == encode(trials[i].outcome);
    ++i;
  });
  cost.read = (now() - start) / count;
  cost.share = static_cast<double>(fs::file_size(file)) / plain;
  cost.plain = plain / count;
  return cost;
}

Cost report(Table& table, const char* what, const std::vector<Trial>& trials, double reach) {
  const Cost cost = cost_of(trials);
  const auto value = fmt::format("{:.3f} of {:.1f} MB in {} trials",
                                 cost.share,
                                 1e-6 * cost.plain * std::ssize(trials),
                                 trials.size());
  if (reach > 0.0) {
    table.full_row(what,
                   value,
                   fmt::format("<= {:g}, every bit the same", reach),
                   cost.share <= reach && cost.is_same);
  } else {
    table.note(what, value);
  }
  return cost;
}

int run(const Options& options) {
  Table table("journal_size", options);
  const ScratchFolder folder;
  const auto trials = search(magic_formula(folder / "study"), options.size(2000, 60));
  const Cost cost =
      report(table, "Magic Formula, 600 measured states, fit and profiles", trials, 0.2);
  table.full_row("of it, to write a trial, committed in groups of 16",
                 fmt::format("{:.2f} ms", 1e3 * cost.write),
                 "< 3 ms",
                 cost.write < 3e-3);
  table.full_row("to read and check it",
                 fmt::format("{:.2f} ms", 1e3 * cost.read),
                 "< 3 ms",
                 cost.read < 3e-3);
  table.row("every bit the same", cost.is_same ? "yes" : "no", "yes", cost.is_same);
  report(table, "the same with noise of 1e-6 on every value", with_ripple(trials), 0.0);
  report(table, "flexible ring over cleats, a Latin hypercube", rings(options.size(12, 2)), 0.0);
  return table.exit_code();
}

}  // namespace
}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  return latsch::benchmarks::run_benchmark(argc, argv, {}, latsch::benchmarks::run);
}
