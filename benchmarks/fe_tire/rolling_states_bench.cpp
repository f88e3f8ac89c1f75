// SPDX-License-Identifier: Apache-2.0
// States of a rolling tire drawn at random near and beyond the limit of friction: each ends in a
// state that obeys the law of friction, or in words, and none takes long. Tire B on a coarse mesh,
// so that ten thousand states take minutes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <string>

#include "cpu_time.h"
#include "free_wheel.h"
#include "shipped_tires.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

using namespace fe_tire;

constexpr double kSpeed = 15.0;  // m/s, of the free wheel
constexpr double kDegree = std::numbers::pi / 180.0;

/// Draws a case: up to 20 deg of slip angle in three of four draws, else up to 80 deg; slips from
/// a locked wheel to twice the rolling speed; camber, turn slip, load, friction and speed.
RollingCase drawn(const FreeWheel& wheel, std::mt19937& random) {
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
  };
  const double widest = uniform(0.0, 1.0) < 0.75 ? 20.0 : 80.0;
  const double kappa = uniform(0.0, 1.0) < 0.75 ? uniform(-0.3, 0.3) : uniform(-1.0, 1.0);
  RollingCase of = wheel.at(kappa,
                            uniform(-widest, widest) * kDegree,
                            uniform(-6.0, 6.0) * kDegree,
                            uniform(-0.05, 0.05));
  of.load = uniform(1000.0, 7000.0);
  of.friction.at_rest = uniform(0.1, 1.5);
  const double faster = std::exp(uniform(std::log(0.1), std::log(2.5)));
  of.speed *= faster;
  of.spin *= faster;
  return of;
}

/// Counts of the states by their end, and the extremes of those found.
struct Ends {
  int found = 0, told = 0, lawless = 0;
  double largest_force = 0.0;  // |Ft|/(mu Fz) - 1
  double largest_load = 0.0;   // |Fz - asked|/asked
  double least_power = 0.0;    // W, lost by sliding
  double longest = 0.0;        // s of processor time
  std::map<std::string, int> reasons;
};

void judge(const RollingState& state, const RollingCase& asked, Ends& ends) {
  const RollingForces& forces = state.forces;
  const double limit = asked.friction.at_rest * forces.force.z();
  const double share = forces.force.head<2>().norm() / limit - 1.0;
  const double load = std::abs(forces.force.z() - *asked.load) / *asked.load;
  ends.largest_force = std::max(ends.largest_force, share);
  ends.largest_load = std::max(ends.largest_load, load);
  ends.least_power = std::min(ends.least_power, forces.friction_power);
  const bool is_lawful = forces.force.allFinite() && forces.moment.allFinite();
  ends.lawless += !is_lawful;
}

}  // namespace

int run(const Options& options) {
  Table table("rolling_states", options);
  FreeWheel wheel(coarse_tire("passenger_225_50R16"), {1, 1, 1}, 4000.0, kSpeed, 1.0);
  const int count = options.size(10'000, 12);
  std::mt19937 random(50);  // NOLINT: the same draws in each run
  Ends ends;
  const double before = cpu_seconds();
  for (int k = 0; k < count; ++k) {
    const RollingCase of = drawn(wheel, random);
    const double begin = cpu_seconds();
    const Result<RollingState> state = wheel.rolling.roll(wheel.state, of);
    ends.longest = std::max(ends.longest, cpu_seconds() - begin);
    if (state) {
      ++ends.found;
      judge(*state, of, ends);
    } else {
      ++ends.told;
      const std::string& reason = state.failure().reason;
      ++ends.reasons[reason.substr(0, reason.find_first_of("0123456789"))];
    }
  }
  table.row("states that end in a state or in words",
            fmt::format("{} of {}", ends.found + ends.told, count),
            fmt::format("{}", count),
            ends.found + ends.told == count);
  table.note("states found", fmt::format("{:.2f} %", 100.0 * ends.found / count));
  for (const auto& [reason, times] : ends.reasons)
    table.note(fmt::format("in words: {} ...", reason), fmt::format("{}", times));
  table.row("states with a force that is not a number",
            fmt::format("{}", ends.lawless),
            "0",
            ends.lawless == 0);
  table.row("largest |Ft|/(mu Fz) - 1",
            fmt::format("{:.1e}", ends.largest_force),
            "<= 1e-6",
            ends.largest_force <= 1e-6);
  table.row("largest |Fz - load|/load",
            fmt::format("{:.1e}", ends.largest_load),
            "<= 1e-5",
            ends.largest_load <= 1e-5);
  table.row("least power lost by sliding",
            fmt::format("{:.1e} W", ends.least_power),
            ">= 0",
            ends.least_power >= 0.0);
  table.row(
      "longest state", fmt::format("{:.1f} s CPU", ends.longest), "<= 60 s", ends.longest <= 60.0);
  table.note("all states", fmt::format("{:.0f} s CPU", cpu_seconds() - before));
  return table.exit_code();
}

}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  return latsch::benchmarks::run_benchmark(argc, argv, {}, latsch::benchmarks::run);
}
