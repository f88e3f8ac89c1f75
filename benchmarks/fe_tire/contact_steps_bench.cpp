// SPDX-License-Identifier: Apache-2.0
// Compares the vertical force Fz at every load step, from the first millimeter on, with CalculiX on
// the same mesh. Tires B and A of [Hempel & Oertel 2016] have the comparison element, smeared
// cords, and sectors of 6 and 4 degrees. In the first millimeters the contact patch is shorter than
// a facet of the tread, and Fz depends on how the pressure on a facet is integrated. Both programs
// use the facets of the mesh and one penalty stiffness; CalculiX intersects the facets with those
// of the ground and has integration points on each part. The benchmark `footprint` shows the error
// of such a mesh compared with finer ones. With friction the load path affects the result: our
// steps of 2.5 mm, as in studies, are compared with CalculiX' steps of a fifth of that.
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "calculix.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/description/reference_tires.h"
#include "shipped_tires.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

using namespace fe_tire;

// tolerances of Fz without and with friction, relative to Fz of the step
constexpr double kReach = 0.01, kFrictionReach = 0.003;

struct Way {
  double step;  // m, our step
  int steps;
  double mu = 0.0;
  int theirs = 1;  // number of CalculiX' steps for each of ours
  double reach = kReach;
};

/// Returns the force at a share of the travel. CalculiX halves a step whose equilibrium it does not
/// find, so its list has further shares beside the requested ones.
double at_share(const std::vector<std::pair<double, double>>& forces, double share) {
  for (const auto& [reached, force] : forces)
    if (std::abs(reached - share) < 1e-4) return force;
  return NAN;
}

void compare(Table& table,
             const std::string& name,
             const TireDescription& description,
             const Way& of) {
  const Mesh mesh = build_mesh(description);
  const Materials materials = build_materials(description);
  FeTire tire(mesh, materials, {.element = ElementKind::full_integration});
  const Inflated inflated = value_of(tire.inflate(description.pressure));
  std::vector<double> way;
  for (int i = 1; i <= of.steps; ++i) way.push_back(of.step * i);
  const Ground ground{.mu = of.mu};
  const std::vector<TireState> states = value_of(tire.press(inflated, ground, way));

  formats::CcxRun run;
  run.title = description.name;
  run.pressure = description.pressure;
  run.modes = 0;
  run.load_increments = of.steps * of.theirs;
  run.ground = formats::CcxGround{inflated.radius, way.back(), ground.stiffness, ground.mu};
  const auto calculix = run_calculix(mesh, materials, run, {.every_force = true});
  if (!calculix) {
    table.row(name + ": CalculiX", "did not finish", "finish", false);
    return;
  }
  for (int i = 0; i < of.steps; ++i) {
    const double ours = tire.stand(states[i]).force.z();
    const double theirs = at_share(calculix->ground_forces, way[i] / way.back());
    const double error = ours / theirs - 1.0;
    table.row(fmt::format("{}: Fz at {:g} mm, ours and CalculiX", name, 1e3 * way[i]),
              fmt::format("{:.1f} and {:.1f} N, {:+.2f} %", ours, theirs, 100.0 * error),
              fmt::format("<= {:g} %", 100.0 * of.reach),
              std::abs(error) <= of.reach);
  }
}

}  // namespace

/// Returns the tire itself; in a smoke run, returns a copy with a mesh for which CalculiX needs a
/// second.
TireDescription on_mesh(TireDescription tire, const Options& options) {
  tire.section.meridional = options.size(tire.section.meridional, 13);
  tire.section.sectors = options.size(tire.section.sectors, 24);
  return tire;
}

int run(const Options& options) {
  Table table("contact_steps", options);
  if (!has_calculix()) {
    table.skip("Fz at every step", "no ccx on the path");
    return table.exit_code();
  }
  compare(table,
          "tire B",
          on_mesh(reference_tire_b(), options),
          {options.size(1e-3, 5e-3), options.size(25, 4)});
  if (options.is_smoke()) return table.exit_code();
  compare(table, "tire A", reference_tire_a(), {1e-3, 10});
  compare(table, "tire B on friction 0.8", reference_tire_b(), {2.5e-3, 4, 0.8, 5, kFrictionReach});
  return table.exit_code();
}

}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  return latsch::benchmarks::run_benchmark(argc, argv, {}, latsch::benchmarks::run);
}
