// SPDX-License-Identifier: Apache-2.0
// Tires A and B, measurements from the model itself: fits, by slopes, find the moduli again
//
// The fit of tire B stands beside one trial of CalculiX on the paper's mesh, computed in the same
// run.
#include <fmt/format.h>

#include <cmath>

#include "base/units.h"
#include "calculix.h"
#include "fit_study.h"
#include "models/fe_tire/description/reference_tires.h"
#include "models/fe_tire/description/tire_description.h"
#include "table.h"

namespace {

using namespace latsch;

constexpr int kWorkers = 2;  // as the studies have it

struct Twin {
  const char *study, *tire;
  long trials;   // at most
  double error;  // of every modulus
  bool beside_calculix;
};

void compare_with_calculix(double cpu_time, benchmarks::Table& table) {
  constexpr double kClear = 2e-3, kTravel = 25e-3;  // m
  constexpr int kModes = 20;
  const fe_tire::TireDescription tire = fe_tire::reference_tire_b();
  const fe_tire::Mesh mesh = build_mesh(tire);
  if (!benchmarks::has_calculix()) {
    table.note("B: CPU time of one trial of CalculiX", "skipped: no ccx on the path");
    return;
  }
  const auto calculix = benchmarks::run_calculix(
      mesh,
      build_materials(tire),
      benchmarks::calculix_trial(tire.name, mesh, tire.pressure, kClear, kTravel, kModes, true));
  if (!calculix) {
    table.row("B: CalculiX", "did not finish", "finish", false);
    return;
  }
  const double share = cpu_time / calculix->cpu_seconds;
  table.note("B: CPU time of one trial of CalculiX",
             fmt::format("{:.1f} s", calculix->cpu_seconds));
  table.row(
      "B: CPU time of the fit in such trials", fmt::format("{:.2f}", share), "<= 1", share <= 1.0);
}

void fit_twin(const Twin& twin, benchmarks::Table& table) {
  const correlation::Study study = benchmarks::fresh_twin(twin.study);
  const benchmarks::Fit fit = benchmarks::fit(study, kWorkers);
  const auto what = [&twin](const std::string& text) {
    return fmt::format("{}: {}", twin.tire, text);
  };
  const Step* best = fit.run.best();
  if (!best) {
    table.row(what("fit"), "no trial succeeded", "a result", false);
    return;
  }
  table.note(what("target"), fmt::format("{:.2g}", best->outcome->value));
  table.row(what("trials"),
            fmt::format("{}, {} of them steps of the optimizer", fit.trials, fit.run.steps.size()),
            fmt::format("<= {}", twin.trials),
            fit.trials <= twin.trials);
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
  table.note(what("wall time, 2 workers"), fmt::format("{:.1f} s", fit.wall_time));
  table.note(what("CPU time of all trials"), fmt::format("{:.1f} s", fit.cpu_time));
  if (twin.beside_calculix) compare_with_calculix(fit.cpu_time, table);
}

int bench() {
  benchmarks::Table table("twin");
  fit_twin({"tire_b_twin", "B", 10, 1e-4, true}, table);
  fit_twin({"tire_a_twin", "A", 12, 1e-3, false}, table);
  return table.exit_code();
}

}  // namespace

int main() { return latsch::benchmarks::guarded(bench); }
