// SPDX-License-Identifier: Apache-2.0
// Mesh convergence of rolling: cornering stiffness, slip stiffness, rolling resistance and
// effective radius of the shipped tires and of two sizes drawn at random, on their own mesh against
// one with halved sectors and columns. Slopes are those of the test `rolling_stiffness`, about the
// free wheel at 60 km/h on ground with friction 1; all rubber has a loss factor of 0.15.
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "cpu_time.h"
#include "drawn_sizes.h"
#include "free_wheel.h"
#include "models/fe_tire/history/prony.h"
#include "models/fe_tire/rolling/rolling_losses.h"
#include "shipped_tires.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

using namespace fe_tire;

constexpr double kDegree = std::numbers::pi / 180.0, kSpeed = 60.0 / 3.6;
/// Slip angle and slip of the differences that are slopes, those of the test `rolling_stiffness`.
constexpr double kAlpha = 0.25 * kDegree, kKappa = 2e-3;
/// Loss factor of every rubber, because no shipped tire states one.
constexpr double kLossFactor = 0.15, kLowest = 0.1, kHighest = 1000.0;  // Hz
/// Load of a drawn size, N for a width of 1 m: about half of what such tires may carry.
constexpr double kLoadByWidth = 2e4;

/// A tire and the load under which it rolls, N.
struct Loaded {
  std::string name;
  TireDescription tire;
  double load;
};

/// Slopes and the like about the free wheel.
struct Slopes {
  double C_alpha = 0.0, C_kappa = 0.0;  // N/rad; N
  double trail = 0.0;                   // m, at small slip angles
  double F_rr = 0.0;                    // N, powers lost over the speed
  double drag = 0.0;                    // N, -Fx of the free wheel
  double R_e = 0.0;                     // m
  double unknowns = 0.0, seconds = 0.0;
};

Slopes slopes(TireDescription of, const MeshRefinement& mesh, double load) {
  const double before = cpu_seconds();
  for (Rubber& rubber : of.rubbers)
    rubber.prony = value_of(constant_loss_factor(kLossFactor, kLowest, kHighest));
  FreeWheel wheel(of, mesh, load, kSpeed, 1.0);
  const RollingState& free = wheel.state;
  const auto forces = [&](double kappa, double alpha) {
    return value_of(wheel.rolling.roll(free, wheel.at(kappa, alpha))).forces;
  };
  const RollingForces left = forces(0.0, kAlpha), right = forces(0.0, -kAlpha),
                      driven = forces(kKappa, 0.0), braked = forces(-kKappa, 0.0);
  Slopes found;
  found.C_alpha = (right.force.y() - left.force.y()) / (2.0 * kAlpha);
  found.trail = (left.moment.z() - right.moment.z()) / (right.force.y() - left.force.y());
  found.C_kappa = (driven.force.x() - braked.force.x()) / (2.0 * kKappa);
  const LossMeter meter(wheel.tire, build_losses(of, mesh), wheel.inflated);
  const RollingLosses lost = meter.measure(free.u, free.alpha, free.of.spin);
  found.F_rr = (lost.rubber + lost.cords + free.forces.friction_power) / kSpeed;
  found.drag = -free.forces.force.x();
  found.R_e = kSpeed / free.of.spin;
  found.unknowns = wheel.tire.mesh().free_dofs();
  found.seconds = cpu_seconds() - before;
  return found;
}

void refine(const Loaded& of, const MeshRefinement& finer, Table& table) {
  const Slopes own = slopes(of.tire, {1, 1, 1}, of.load), fine = slopes(of.tire, finer, of.load);
  const auto error = [](double value, double judge) { return value / judge - 1.0; };
  const auto row = [&](const char* what, double value, double judge, double reach, double unit) {
    table.full_row(fmt::format("{}, {:.0f} N: {}", of.name, of.load, what),
                   fmt::format("{:.5g}, {:+.2f} %", value / unit, 1e2 * error(value, judge)),
                   fmt::format("<= {:g} %", 1e2 * reach),
                   std::abs(error(value, judge)) <= reach);
  };
  row("C_alpha, N/deg", own.C_alpha, fine.C_alpha, 0.02, 1.0 / kDegree);
  row("C_kappa, N/%", own.C_kappa, fine.C_kappa, 0.02, 100.0);
  row("F_rr, N", own.F_rr, fine.F_rr, 0.05, 1.0);
  row("R_e, mm", own.R_e, fine.R_e, 1e-3, 1e-3);
  table.note(of.name + ": -Fx of the free wheel",
             fmt::format("{:.3f} N, {:+.2f} %", own.drag, 1e2 * error(own.drag, fine.drag)));
  table.note(of.name + ": trail at small slip angles, own and finer mesh",
             fmt::format("{:.2f}, {:.2f} mm", 1e3 * own.trail, 1e3 * fine.trail));
  table.note(of.name + ": unknowns and CPU time of both meshes",
             fmt::format("{:.0f}, {:.0f}; {:.0f}, {:.0f} s",
                         own.unknowns,
                         fine.unknowns,
                         own.seconds,
                         fine.seconds));
}

std::vector<Loaded> shipped() {
  std::vector<Loaded> tires;
  for (const auto& [name, load] : {std::pair{"passenger_205_55R16", 4000.0},
                                   std::pair{"race_16x7.5-10", 1200.0},
                                   std::pair{"passenger_225_50R16", 4800.0},
                                   std::pair{"passenger_235_45R20", 5000.0}})
    tires.push_back({name, shipped_tire(name), load});
  return tires;
}

}  // namespace

int run(const Options& options) {
  Table table("rolling_mesh", options);
  const MeshRefinement finer(static_cast<int>(options.integer("--around", 2)),
                             static_cast<int>(options.integer("--along", 2)),
                             static_cast<int>(options.integer("--through", 1)));
  if (options.is_smoke()) {
    refine(
        {"coarse 225/50R16", tire_for(options, "passenger_225_50R16"), 4800.0}, {2, 1, 1}, table);
    return table.exit_code();
  }
  const std::string only = options.text("--tire");
  for (const Loaded& tire : shipped())
    if (only.empty() || only == tire.name) refine(tire, finer, table);
  const auto seed = static_cast<std::uint64_t>(options.integer("SEED", 2026));
  if (only.empty() || only == "drawn")
    for (const SizedTire& drawn : draw_sizes(seed, 2))
      refine({drawn.size, drawn.tire, kLoadByWidth * drawn.width}, finer, table);
  return table.exit_code();
}

}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  return latsch::benchmarks::run_benchmark(
      argc,
      argv,
      {{"SEED", "", "of the sizes drawn at random"},
       {"--tire", "NAME", "one tire alone: the name of its file, or drawn"},
       {"--around", "N", "sectors of the finer mesh in place of one; 2 if not given"},
       {"--along", "N", "columns in place of one; 2 if not given"},
       {"--through", "N", "rows in place of one; 1 if not given"}},
      latsch::benchmarks::run);
}
