// SPDX-License-Identifier: Apache-2.0
// CPU time of the data of a Magic Formula on the virtual flat track: the test steady_states at its
// defaults on tire B as shipped (in a smoke run on a coarse mesh), from inflation. At each of three
// loads 30 slip angles up to 10 deg, 20 slips up to 0.2, and 5 states of camber with a slip angle.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "cpu_time.h"
#include "experiment/rigs/fe_rolling/steady_table.h"
#include "shipped_tires.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

using experiment::TireRig;

/// Adds `count` values between both limits, without 0, as lines of the table. `line` takes the
/// value.
template <class Line>
void add(std::string& text, int count, double most, const Line& line) {
  for (int k = 0; k < count; ++k) text += line(most * (2.0 * (k + 0.5) / count - 1.0));
}

/// The states of the table, in the order of a flat track: sweep by sweep.
std::string flat_track(const Options& options) {
  std::string text = "Fz [N],kappa,alpha [deg],gamma [deg]\n";
  for (const double load : {2000.0, 4000.0, 6000.0}) {
    add(text, options.size(30, 4), 10.0, [&](double alpha) {
      return fmt::format("{},0,{:.6f},0\n", load, alpha);
    });
    add(text, options.size(20, 4), 0.2, [&](double kappa) {
      return fmt::format("{},{:.6f},0,0\n", load, kappa);
    });
    add(text, options.size(5, 2), 3.0, [&](double alpha) {
      return fmt::format("{},0,{:.6f},3\n", load, alpha);
    });
  }
  return text;
}

}  // namespace

int run(const Options& options) {
  Table table("rolling_data", options);
  const fe_tire::TireDescription description = tire_for(options, "passenger_225_50R16");
  const auto states = formats::CsvTable::parse(flat_track(options), "states.csv");
  const double before = cpu_seconds();
  fe_tire::FeTire tire(description);
  TireRig rig(tire, description.pressure);
  int found = 0;
  const Status done = experiment::roll_table(
      rig, states, {}, [&](const Channels& told) { found += static_cast<int>(told["Fy"].size()); });
  const double all = cpu_seconds() - before;
  table.row("states not found",
            done.ok() ? "0" : done.failure().reason,
            "0",
            done.ok() && found == states.rows());
  table.full_row(fmt::format("{} states of a Magic Formula's data, from inflation", states.rows()),
                 fmt::format("{:.1f} s CPU, {:.2f} s a state", all, all / states.rows()),
                 "<= 150 s",
                 all <= 150.0);
  return table.exit_code();
}

}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  return latsch::benchmarks::run_benchmark(argc, argv, {}, latsch::benchmarks::run);
}
