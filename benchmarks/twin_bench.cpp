// SPDX-License-Identifier: Apache-2.0
// Tire B, measurements from the model itself: the fit, by slopes, finds the three moduli again
#include <fmt/format.h>

#include <cmath>

#include "base/units.h"
#include "fit_study.h"
#include "table.h"

namespace {

int bench() {
  using namespace latsch;
  benchmarks::Table table("twin");
  const correlation::Study study = benchmarks::fresh_twin("tire_b_twin");
  const benchmarks::Fit fit = benchmarks::fit(study, 2);
  const Step* best = fit.run.best();
  if (!best) {
    table.row("fit", "no trial succeeded", "a result", false);
    return table.exit_code();
  }
  const double target = best->outcome->value;
  table.note("target", fmt::format("{:.2g}", target));
  table.row("steps of the optimizer",
            fmt::format("{}", fit.run.steps.size()),
            "<= 10",
            fit.run.steps.size() <= 10);
  for (int i = 0; i < study.space.size(); ++i) {
    const DesignVariable& variable = study.space[i];
    const double truth = study.model.get(variable.paths.front());
    const double error = best->point.values[i] / truth - 1.0;
    table.row(variable.name + " modulus against the tire file",
              fmt::format("{} ({:+.5f} %)",
                          format_quantity(best->point.values[i], variable.unit, 5),
                          100 * error),
              "within 0.01 %",
              std::abs(error) < 1e-4);
    table.note(variable.name + " at the start",
               fmt::format("{} ({:+.0f} %)",
                           format_quantity(variable.initial, variable.unit, 5),
                           100 * (variable.initial / truth - 1.0)));
  }
  table.note("trials", fmt::format("{}", fit.trials));
  table.note("wall time, 2 workers", fmt::format("{:.1f} s", fit.wall_time));
  table.note("CPU time of all trials", fmt::format("{:.1f} s", fit.cpu_time));
  return table.exit_code();
}

}  // namespace

int main() { return latsch::benchmarks::guarded(bench); }
