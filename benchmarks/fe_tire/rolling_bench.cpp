// SPDX-License-Identifier: Apache-2.0
// Accuracy of the rotating finite-element tire, compared with CalculiX, closed forms and finer
// meshes. The disc ring of verification/spinning_ring at 100 rad/s is compared with CalculiX 2.20
// and with an independent program on the same mesh. A free ring is compared with Bryan's closed
// form for the frequencies of waves that travel with and against the rotation. Growth and
// standing-wave speed of shipped tires on their own sectors are compared with meshes of twice and
// four times as many sectors.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/motion/spinning_tire.h"
#include "ring_mesh.h"
#include "rolling_rows.h"
#include "shipped_tires.h"
#include "spinning_rings.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

using namespace fe_tire;

std::string percent(double share) { return fmt::format("{:.4f} %", 1e2 * share); }

void gyro_ring(Table& table) {
  const verification::GyroRingErrors errors = verification::gyro_ring_errors();
  const auto row = [&](const char* what, double error, double reach) {
    table.row(
        fmt::format("gyro_ring, {}", what), percent(error), "<= " + percent(reach), error <= reach);
  };
  row("24 modes in axes that spin along, against CalculiX", errors.calculix, 1e-3);
  row("24 modes in axes that spin along, against the independent program",
      errors.independent,
      2e-4);
  row("24 modes in axes that stand, by omega = sigma + n Omega", errors.hub, 2e-4);
  row("six modes in axes that stand, by (W.1)", errors.by_flow, 1e-4);
  row("growth", errors.growth, 1e-4);
  row("standing-wave speed, 36 sectors", errors.standing_wave, 2e-3);
}

void free_ring(const Options& options, Table& table) {
  const verification::SplitErrors by_spin = verification::bryan_errors(options.size(120, 60));
  table.row("free ring, n = 2 ... 5, in axes that spin along: split",
            percent(by_spin.split),
            "<= 0.05 %",
            by_spin.split <= 5e-4);
  table.full_row("free ring, n = 2 ... 5, in axes that spin along: product",
                 percent(by_spin.product),
                 "<= 0.05 %",
                 by_spin.product <= 5e-4);
  const verification::SplitErrors by_flow =
      verification::bryan_errors_by_flow(options.size(120, 60));
  table.full_row("free ring, n = 2 ... 5, by (W.1): split",
                 percent(by_flow.split),
                 "<= 0.5 %",
                 by_flow.split <= 5e-3);
  table.full_row("free ring, n = 2 ... 5, by (W.1): product",
                 percent(by_flow.product),
                 "<= 0.5 %",
                 by_flow.product <= 5e-3);
}

/// Radial growth by rotation, m, and the speed at which standing waves begin, rad/s.
struct Spun {
  double growth = 0.0, standing_wave = 0.0;
  int n = 0;
};
Spun spun(const TireDescription& tire, int around) {
  FeTire fine(build_mesh(tire, {around, 1, 1}),
              build_materials(tire, {around, 1, 1}),
              {.element = tire.element});
  const Inflated at_rest = value_of(fine.inflate(tire.pressure));
  SpinningTire spinning(fine);
  // m/s; below the speed at which standing waves begin on tires with soft treads and narrow sectors
  constexpr double kSpeed = 15.0;
  const Inflated state = value_of(spinning.inflate(at_rest, kSpeed / at_rest.radius));
  const StandingWave wave = value_of(spinning.standing_wave(at_rest));
  return {state.growth - at_rest.growth, wave.speed, wave.n};
}

void shipped(const std::string& name, const Options& options, Table& table) {
  const TireDescription tire = tire_for(options, name);
  const Spun own = spun(tire, 1), twice = spun(tire, 2), four = spun(tire, 4);
  table.full_row(
      fmt::format("{}: growth by 54 km/h, against four times the sectors", name),
      fmt::format("{:.4f} mm, {}", 1e3 * own.growth, percent(own.growth / four.growth - 1.0)),
      "<= 0.5 %",
      std::abs(own.growth / four.growth - 1.0) <= 5e-3);
  table.note(fmt::format("{}: standing wave, sectors as they are, twice, four times", name),
             fmt::format("{:.1f} (n = {}), {:.1f} ({}), {:.1f} rad/s ({})",
                         own.standing_wave,
                         own.n,
                         twice.standing_wave,
                         twice.n,
                         four.standing_wave,
                         four.n));
}

}  // namespace

int run(const Options& options) {
  Table table("rolling", options);
  gyro_ring(table);
  free_ring(options, table);
  roll_rings(options, table);
  roll_tires(options, table);
  if (options.is_smoke()) {
    shipped("passenger_205_55R16", options, table);
    return table.exit_code();
  }
  for (const char* tire :
       {"passenger_205_55R16", "race_16x7.5-10", "passenger_225_50R16", "passenger_235_45R20"})
    shipped(tire, options, table);
  return table.exit_code();
}

}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  return latsch::benchmarks::run_benchmark(argc, argv, {}, latsch::benchmarks::run);
}
