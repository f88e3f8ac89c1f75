// SPDX-License-Identifier: Apache-2.0
// Tire B, measurements from the model itself: generating-set search finds the three moduli again
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
  table.row("target", fmt::format("{:.3f} %", 100 * target), "< 0.5 %", target < 5e-3);
  for (int i = 0; i < study.space.size(); ++i) {
    const DesignVariable& variable = study.space[i];
    const double truth = study.model.get(variable.paths.front());
    const double error = best->point.values[i] / truth - 1.0;
    table.row(variable.name + " modulus against the tire file",
              fmt::format("{} ({:+.3f} %)",
                          format_quantity(best->point.values[i], variable.unit, 5),
                          100 * error),
              "within 1 %",
              std::abs(error) < 0.01);
    table.note(variable.name + " at the start",
               fmt::format("{} ({:+.0f} %)",
                           format_quantity(variable.initial, variable.unit, 5),
                           100 * (variable.initial / truth - 1.0)));
  }
  table.note("steps of the optimizer", fmt::format("{}", fit.run.steps.size()));
  table.note("trials", fmt::format("{}", fit.trials));
  table.note("wall time, 2 workers", fmt::format("{:.1f} s", fit.wall_time));
  table.note("CPU time of all trials", fmt::format("{:.1f} s", fit.cpu_time));
  return table.exit_code();
}

}  // namespace

int main() { return latsch::benchmarks::guarded(bench); }
