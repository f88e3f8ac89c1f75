// SPDX-License-Identifier: Apache-2.0
// Tires A and B, measurements from the model itself: fits, by slopes, find the moduli again
#include <fmt/format.h>

#include <cmath>

#include "base/units.h"
#include "fit_study.h"
#include "table.h"

namespace {

using namespace latsch;

struct Twin {
  const char *study, *tire;
  std::size_t steps;  // at most
  double error;       // of every modulus
};

void fit_twin(const Twin& twin, benchmarks::Table& table) {
  const correlation::Study study = benchmarks::fresh_twin(twin.study);
  const benchmarks::Fit fit = benchmarks::fit(study, 2);
  const auto what = [&twin](const std::string& text) {
    return fmt::format("{}: {}", twin.tire, text);
  };
  const Step* best = fit.run.best();
  if (!best) {
    table.row(what("fit"), "no trial succeeded", "a result", false);
    return;
  }
  table.note(what("target"), fmt::format("{:.2g}", best->outcome->value));
  table.row(what("steps of the optimizer"),
            fmt::format("{}", fit.run.steps.size()),
            fmt::format("<= {}", twin.steps),
            fit.run.steps.size() <= twin.steps);
  for (int i = 0; i < study.space.size(); ++i) {
    const DesignVariable& variable = study.space[i];
    const double truth = study.model.get(variable.paths.front());
    const double error = best->point.values[i] / truth - 1.0;
    table.row(what(variable.name + " modulus against the tire file"),
              fmt::format("{} ({:+.5f} %)",
                          format_quantity(best->point.values[i], variable.unit, 5),
                          100 * error),
              fmt::format("within {} %", 100 * twin.error),
              std::abs(error) < twin.error);
    table.note(what(variable.name + " at the start"),
               fmt::format("{} ({:+.0f} %)",
                           format_quantity(variable.initial, variable.unit, 5),
                           100 * (variable.initial / truth - 1.0)));
  }
  table.note(what("trials"), fmt::format("{}", fit.trials));
  table.note(what("wall time, 2 workers"), fmt::format("{:.1f} s", fit.wall_time));
  table.note(what("CPU time of all trials"), fmt::format("{:.1f} s", fit.cpu_time));
}

int bench() {
  benchmarks::Table table("twin");
  fit_twin({"tire_b_twin", "B", 10, 1e-4}, table);
  fit_twin({"tire_a_twin", "A", 12, 1e-3}, table);
  return table.exit_code();
}

}  // namespace

int main() { return latsch::benchmarks::guarded(bench); }
