// SPDX-License-Identifier: Apache-2.0
// What is published of a 205/55 R16, shown by a flexible ring: studies/ring_tire_data/rolling.toml
//
// Sixteen numbers of the ring are fitted, as `latsch run` does, to sixteen values: two loads, five
// frequencies, three dampings, three stiffnesses of the standing tire, slip and cornering stiffness
// and the trail of the rolling one. What to reach: each of them within 3 %.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/units.h"
#include "correlation/observable/objective.h"
#include "correlation/study/study.h"
#include "correlation/target/residuals.h"
#include "correlation/target/study_trials.h"
#include "experiment/language.h"
#include "fit_study.h"
#include "table.h"

namespace {

using namespace latsch;

int bench() {
  const auto file =
      std::filesystem::path(LATSCH_SOURCE_DIR) / "studies/ring_tire_data/rolling.toml";
  const correlation::Study study = correlation::read_study(file, experiment::language());
  const benchmarks::Fit fit = benchmarks::fit(study, 2);
  const auto trial = correlation::simulate_all(study, fit.run.best()->point);
  if (!trial) throw InputError(trial.failure().reason);
  benchmarks::Table table("ring_data");
  double worst = 0.0;
  for (const correlation::StudyExperiment& experiment : study.experiments) {
    const auto errors = correlation::compare(experiment, *trial).errors;
    for (std::size_t i = 0; i < errors.size(); ++i) {
      worst = std::max(worst, std::abs(errors[i]));
      table.note(experiment.observable->rows()[i], fmt::format("{:+.2f} %", -100.0 * errors[i]));
    }
  }
  for (int i = 0; i < study.space.size(); ++i) {
    const DesignVariable& variable = study.space.variables()[static_cast<std::size_t>(i)];
    const double value = fit.run.best()->point.values[static_cast<std::size_t>(i)];
    table.note(variable.name,
               fmt::format("{:.3g} {}", Unit::of(variable.unit).from_si(value), variable.unit));
  }
  table.row("the worst of sixteen published values",
            fmt::format("{:.2f} %", 100.0 * worst),
            "<= 3 %",
            worst <= 0.03);
  table.note("trials, their CPU time", fmt::format("{}, {:.0f} s", fit.trials, fit.cpu_time));
  return table.exit_code();
}

}  // namespace

int main() { return latsch::benchmarks::guarded(bench); }
