// SPDX-License-Identifier: Apache-2.0
// Measured race tire: fitted to the loaded radius at 83 kPa, predicted at 69 and 97 kPa
#include <fmt/format.h>

#include "correlation/target/study_trials.h"
#include "fit_study.h"
#include "table.h"

namespace {

int bench() {
  using namespace latsch;
  // Twice the force error of the published fits [Hempel & Oertel 2016]: here the contour is
  // assumed.
  constexpr double kFit = 0.04;
  benchmarks::Table table("race_tire");
  const correlation::Study study = benchmarks::study_of_folder("race_tire");
  const benchmarks::Fit fit = benchmarks::fit(study, 2);
  const Step* best = fit.run.best();
  if (!best) {
    table.row("fit", "no trial succeeded", "a result", false);
    return table.exit_code();
  }
  const auto channels = correlation::simulate_all(study, best->point);
  if (!channels) {
    table.row("prediction", channels.failure().reason, "a result", false);
    return table.exit_code();
  }
  for (const auto& experiment : study.experiments) {
    const auto comparison = compare(experiment, *channels);
    const std::string errors = fmt::format("mean {:.2f} %, largest {:.2f} %",
                                           100 * comparison.mean_error,
                                           100 * comparison.largest_error);
    const std::string what =
        fmt::format("force at the measured loaded radius, {}", experiment.name);
    if (experiment.fitted) {
      table.row(what + ", fitted", errors, "mean <= 4 %", comparison.mean_error <= kFit);
    } else {
      table.note(what + ", predicted", errors);
    }
  }
  table.note("trials", fmt::format("{}", fit.trials));
  table.note("wall time, 2 workers", fmt::format("{:.1f} s", fit.wall_time));
  return table.exit_code();
}

}  // namespace

int main() { return latsch::benchmarks::guarded(bench); }
