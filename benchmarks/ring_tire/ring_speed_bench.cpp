// SPDX-License-Identifier: Apache-2.0
// The flexible ring tire over a cleat: CPU time over simulated time, cost of refinement, energy
// balance, and order of convergence.
#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <vector>

#include "models/ring_tire/ring/ring_tire.h"
#include "models/road/plane_road.h"
#include "models/road/profile_road.h"
#include "ring_balance.h"
#include "ring_kerb.h"
#include "table.h"
#include "yardstick.h"

namespace {

using namespace latsch;
using namespace latsch::ring_tire;
using benchmarks::ring_of;

WheelMotion rolling(double height, double speed) {
  WheelMotion motion;
  motion.center.z() = height;
  motion.velocity.x() = speed;
  motion.spin_rate = speed / 0.3085;
  return motion;
}

struct Cost {
  double time;         // CPU time over simulated time
  double evaluations;  // number of evaluations of all forces in a time step
};
constexpr Cost kFailed{1e9, 1.0};

/// Returns the cost of 0.3 s at 60 km/h over a cleat of 15 x 30 mm in steps of 0.5 ms; kFailed if a
/// step has no solution.
Cost run(const RingParameters& ring, bool show) {
  const road::ProfileRoad road = road::cleat_road(2.0, 0.015, 0.03, 0.005);
  RingTire tire(ring);
  WheelMotion motion = rolling(tire.free_radius() - 0.022, 60.0 / 3.6);
  if (const auto stands = tire.settle(motion, road, 0.0); !stands) {
    fmt::print("{}\n", stands.failure().reason);
    return kFailed;
  }
  const double h = 5e-4, duration = 0.3;
  const int steps = static_cast<int>(std::lround(duration / h));
  const long evaluations = tire.counts().evaluations, factors = tire.counts().factorizations;
  const double start = benchmarks::cpu_time();
  double most = 0.0;
  for (int i = 1; i <= steps; ++i) {
    motion.center.x() += h * motion.velocity.x();
    motion.spin += h * motion.spin_rate;
    const auto hub = tire.advance(motion, road, i * h, h);
    if (!hub) {
      fmt::print("{}\n", hub.failure().reason);
      return kFailed;
    }
    most = std::max(most, hub->force.z());
  }
  const Cost cost{(benchmarks::cpu_time() - start) / duration,
                  static_cast<double>(tire.counts().evaluations - evaluations) / steps};
  if (show)
    fmt::print(
        "{} nodes x {} x {}: {:.3f} of real time, {:.2f} evaluations and {:.2f} "
        "factorizations a step, Fz up to {:.0f} N\n",
        ring.nodes,
        ring.tread.blocks,
        ring.tread.lines,
        cost.time,
        cost.evaluations,
        static_cast<double>(tire.counts().factorizations - factors) / steps,
        most);
  return cost;
}

/// Other programs share the machine, so the least time of several rounds is nearest to the cost of
/// the program itself. All tires run in each round, under the same conditions, because ratios of
/// their times are judged.
std::vector<Cost> least_costs(const std::vector<RingParameters>& tires, int rounds) {
  std::vector<Cost> least;
  for (const RingParameters& ring : tires) least.push_back(run(ring, true));
  for (int round = 1; round < rounds; ++round) {
    for (std::size_t k = 0; k < tires.size(); ++k) {
      least[k].time = std::min(least[k].time, run(tires[k], false).time);
    }
  }
  return least;
}

/// Returns the largest increase of the energy from one time step to the next after the road below
/// the tire has been removed, relative to the energy stored by the load.
double energy_growth() {
  RingTire tire(ring_of(80, 10, 6), {.tolerance = 1e-3});
  WheelMotion motion;
  motion.center.z() = tire.free_radius() - 0.025;
  const road::PlaneRoad pit({.height = -1.0});
  if (!tire.settle(motion, pit, 0.0)) return 1.0;
  const double rest = tire.energy();
  if (!tire.settle(motion, road::PlaneRoad(), 0.0)) return 1.0;
  if (!tire.advance(motion, pit, 0.0, 1e-6)) return 1.0;
  double last = tire.energy(), growth = 0.0;
  const double first = last - rest;
  for (int i = 0; i < 400; ++i) {
    if (!tire.advance(motion, pit, 0.0, 5e-4)) return 1.0;
    growth = std::max(growth, tire.energy() - last);
    last = tire.energy();
  }
  return growth / first;
}

/// Returns the order of convergence of the vertical force in the time step, on a smooth road that
/// rises and falls under the tire.
double order_on_a_smooth_road() {
  std::vector<double> forces;
  for (const int parts : {80, 160, 320}) {
    RingTire tire(ring_of(80, 10, 6), {.tolerance = 1e-5});
    const double h = 0.02 / parts, height = tire.free_radius() - 0.015;
    WheelMotion motion;
    motion.center.z() = height;
    double Fz = tire.settle(motion, road::PlaneRoad(), 0.0) ? 0.0 : 1e9;
    for (int i = 1; i <= parts; ++i) {
      const double omega = 2.0 * M_PI * 25.0, t = i * h;
      motion.center.z() = height - 0.0025 * (1.0 - std::cos(omega * t));
      motion.velocity.z() = -0.0025 * omega * std::sin(omega * t);
      const auto hub = tire.advance(motion, road::PlaneRoad(), t, h);
      if (hub) Fz = hub->force.z();
    }
    forces.push_back(Fz);
  }
  return std::log2((forces[1] - forces[0]) / (forces[2] - forces[1]));
}

/// Effects of the discretization on a wheel that rolls at constant speed over a smooth road.
struct Ripple {
  double moment = 0.0;                 // N m, mean moment about the axle
  double Fx = std::nan(""), Fz = 0.0;  // N, amplitude at the frequency with which segments pass
};

/// Measures one revolution after one of running in. The result is NaN if a time step has no
/// solution.
Ripple ripple_of(const RingParameters& ring, double speed, double step, double radius) {
  RingTire tire(ring);
  const road::PlaneRoad road;
  WheelMotion motion = rolling(tire.free_radius() - 0.022, speed);
  motion.spin_rate = speed / radius;
  if (!tire.settle(motion, road, 0.0)) return {};
  const int turn = static_cast<int>(std::lround(2.0 * M_PI / (motion.spin_rate * step)));
  std::vector<double> Fx, Fz, angle;
  Ripple ripple;
  for (int i = 1; i <= 2 * turn; ++i) {
    motion.center.x() += step * motion.velocity.x();
    motion.spin += step * motion.spin_rate;
    const auto hub = tire.advance(motion, road, i * step, step);
    if (!hub) return {};
    if (i <= turn) continue;
    Fx.push_back(hub->force.x());
    Fz.push_back(hub->force.z());
    angle.push_back(motion.spin);
    ripple.moment += hub->moment.y() / turn;
  }
  const auto amplitude = [&](const std::vector<double>& force) {
    std::complex<double> sum = 0.0;
    for (std::size_t i = 0; i < force.size(); ++i)
      sum += (force[i] - force[0]) * std::polar(2.0 / turn, -ring.nodes * angle[i]);
    return std::abs(sum);
  };
  ripple.Fx = amplitude(Fx);
  ripple.Fz = amplitude(Fz);
  return ripple;
}

/// Returns the ripple of a freely rolling wheel. Two secant steps find the rolling radius at which
/// the moment about the axle vanishes.
Ripple free_ripple(const RingParameters& ring, double speed, double step) {
  double before = 0.3070, radius = 0.3076;
  double last = ripple_of(ring, speed, step, before).moment;
  Ripple now = ripple_of(ring, speed, step, radius);
  for (int i = 0; i < 2; ++i) {
    const double next = radius - now.moment * (radius - before) / (now.moment - last);
    before = radius;
    last = now.moment;
    radius = next;
    now = ripple_of(ring, speed, step, radius);
  }
  return now;
}

/// The limit is a tenth of the amplitudes of Fx of an earlier kind of ring, of straight chords with
/// its tread on Catmull-Rom splines, with 80 segments x 12 or 50 blocks.
void ripple_rows(benchmarks::Table& table) {
  struct Case {
    double speed, step, chords;
  };
  for (const auto& [speed, step, chords] :
       {Case{2.0, 5e-4, 12.9}, {5.0, 5e-4, 5.40}, {60.0 / 3.6, 1.25e-4, 2.24}}) {
    const Ripple same = free_ripple(ring_of(80, 12, 10), speed, step);
    table.note(
        fmt::format("ripple of Fx, free rolling at {:.1f} m/s, 80 segments x 12 blocks", speed),
        fmt::format(
            "{:.2f} N, {:.3f} of the chords'; Fz {:.2f} N", same.Fx, same.Fx / chords, same.Fz));
    const Ripple ripple = free_ripple(ring_of(100, 12, 10), speed, step);
    table.row(
        fmt::format("the same, 100 segments x 12 blocks"),
        fmt::format("{:.2f} N, {:.3f} of the chords' with 80 x 50", ripple.Fx, ripple.Fx / chords),
        "<= 0.1",
        ripple.Fx <= 0.1 * chords);
  }
}

/// Compares the cost of saving and restoring a state of the tire with that of a time step of 0.2 ms
/// over a cleat at 60 km/h, with 100 segments x 12 blocks x 10 lines.
void state_row(benchmarks::Table& table, int steps) {
  const road::ProfileRoad road = road::cleat_road(2.0, 0.015, 0.03, 0.005);
  RingTire tire(ring_of(100, 12, 10));
  WheelMotion motion = rolling(tire.free_radius() - 0.022, 60.0 / 3.6);
  constexpr double kStep = 2e-4;
  constexpr int kCopies = 20;
  double step = 0.0, copy = 0.0;
  bool same = static_cast<bool>(tire.settle(motion, road, 0.0));
  for (int i = 1; same && i <= steps; ++i) {
    motion.center.x() += kStep * motion.velocity.x();
    motion.spin += kStep * motion.spin_rate;
    const double start = benchmarks::cpu_time();
    same = static_cast<bool>(tire.advance(motion, road, i * kStep, kStep));
    const double stepped = benchmarks::cpu_time();
    const RingState state = tire.state();
    for (int k = 0; k < kCopies; ++k) {
      tire.restore(state);
      same = same && tire.state().place.cols() == state.place.cols();
    }
    copy += (benchmarks::cpu_time() - stepped) / kCopies;
    step += stepped - start;
    same = same && tire.state() == state;
  }
  table.row(
      "copy and restore of a state",
      fmt::format("{:.1f} % of a step, {}", 100.0 * copy / step, same ? "same bits" : "DIFFERS"),
      "<= 5 %, same bits",
      same && (copy <= 0.05 * step || steps < 200));
}

int ring_speed(const benchmarks::Options& options) {
  benchmarks::Table table("ring_speed", options);
  const benchmarks::RingRounds rounds =
      options.size(benchmarks::RingRounds{}, benchmarks::RingRounds{1, 0.02});
  if (options.is_smoke()) {  // leaves out the rows that need the refined rings
    benchmarks::momentum_row(table);
    benchmarks::slopes_rows(table, rounds);
    benchmarks::free_wheel_rows(table, rounds);
    benchmarks::car_row(table, rounds);
    benchmarks::drum_row(table, rounds);
    state_row(table, 20);
    return table.exit_code();
  }
  RingParameters bent = ring_of(80, 50, 10);
  bent.belt.bending_across = 8.0;
  const std::vector<Cost> costs = least_costs({ring_of(80, 50, 10),
                                               ring_of(80, 25, 10),
                                               ring_of(160, 50, 10),
                                               ring_of(80, 5, 10),
                                               bent,
                                               ring_of(320, 50, 10)},
                                              rounds.count);
  const double whole = costs[0].time, half_blocks = costs[1].time, double_nodes = costs[2].time;
  table.row("80 segments x 50 blocks x 10 lines, 0.5 ms, cleat at 60 km/h",
            fmt::format("{:.3f} x real time", whole),
            "<= 0.5",
            whole <= 0.5);
  const double atan = benchmarks::beside(benchmarks::Yardstick::atan, 20, [] {}).yardstick;
  table.note("the same in arc tangents of the C library a simulated second",
             fmt::format("{:.1f} million", 1e-6 * whole / atan));
  table.note("80 segments x 50 blocks in all, on 10 lines",
             fmt::format("{:.3f} x real time", costs[3].time));
  table.note("the same with sections that bend", fmt::format("{:.3f} x real time", costs[4].time));
  table.row("twice the blocks",
            fmt::format("{:.2f} x the time", whole / half_blocks),
            "<= 2.1",
            whole <= 2.1 * half_blocks);
  table.row("twice the segments",
            fmt::format("{:.2f} x the time", double_nodes / whole),
            "<= 2.1",
            double_nodes <= 2.1 * whole);
  table.note("four times the segments", fmt::format("{:.2f} x the time", costs[5].time / whole));
  table.note("four times the segments, an evaluation of all forces",
             fmt::format("{:.2f} x the time",
                         costs[5].time / costs[5].evaluations / (whole / costs[0].evaluations)));
  const double growth = energy_growth();
  table.row("energy without input, largest growth in a step",
            fmt::format("{:.1e} of the load's", growth),
            "<= 0",
            growth <= 0.0);
  benchmarks::momentum_row(table);
  benchmarks::energy_rows(table);
  benchmarks::kerb_rows(table, rounds);
  benchmarks::car_row(table, rounds);
  benchmarks::slopes_rows(table, rounds);
  benchmarks::free_wheel_rows(table, rounds);
  benchmarks::bottoming_rows(table, rounds);
  benchmarks::drum_row(table, rounds);
  ripple_rows(table);
  state_row(table, 200);
  const double order = order_on_a_smooth_road();
  table.row("order on a smooth road", fmt::format("{:.2f}", order), ">= 1.9", order >= 1.9);
  return table.exit_code();
}

}  // namespace

int main(int argc, char** argv) {
  return latsch::benchmarks::run_benchmark(argc, argv, {}, ring_speed);
}
