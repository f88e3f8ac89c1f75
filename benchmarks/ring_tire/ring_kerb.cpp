// SPDX-License-Identifier: Apache-2.0
#include "ring_kerb.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "models/ring_tire/description/ring_parameters_testing.h"
#include "models/ring_tire/ring/motion_slopes_testing.h"
#include "models/road/drum_road.h"
#include "models/road/kerb.h"
#include "models/road/plane_road.h"
#include "models/tire/free_wheel.h"
#include "yardstick.h"

namespace latsch::benchmarks {

using namespace ring_tire;

RingParameters ring_of(int nodes, int blocks, int lines) {
  RingParameters ring = passenger_ring();
  ring.nodes = nodes;
  ring.sidewall.radial.dynamic_stiffening = 0.2;
  ring.sidewall.tangential.dynamic_stiffening = 0.05;
  ring.tread.lines = lines;
  ring.tread.blocks = blocks;
  ring.tread.damping_time = 1e-4;
  return ring;
}

namespace {

constexpr double kStep = 2e-4, kSpeed = 60.0;
constexpr double kSample = 1e-3;  // s, sampling interval of the compared forces

/// Returns the ring tire of the rows whose time is measured.
RingParameters small_ring() { return ring_of(48, 8, 6); }

/// Returns a kerb of four valleys one after the other, each 0.8 m long, 0.8 m wide and 25 mm deep;
/// with a positive `height`, of four hills.
road::ProfileRoad kerb(double height = -0.025) {
  return road::kerb_road({.shape = road::Kerb::Shape::triangle,
                          .pitch = 0.8,
                          .width = 0.8,
                          .height = height,
                          .count = 4,
                          .start = {1.0, -0.4}});
}

WheelMotion rolling(const RingTire& tire, double speed) {
  WheelMotion motion;
  motion.center.z() = tire.free_radius() - 0.022;
  motion.velocity.x() = speed;
  motion.spin_rate = speed / 0.3085;
  return motion;
}

struct Run {
  double time;  // CPU time over simulated time
  std::vector<double> Fx, Fz;
};

/// Rolls the ring over the kerb. Returns nothing if a time step has no solution. If `on_drum`, the
/// axle does not move.
std::optional<Run> roll(const RingParameters& ring,
                        const RingSettings& settings,
                        const road::Road& road,
                        double speed,
                        double step,
                        double duration,
                        bool on_drum = false) {
  RingTire tire(ring, settings);
  WheelMotion motion = rolling(tire, speed);
  if (on_drum) motion.velocity.setZero();
  if (!tire.settle(motion, road, 0.0)) return std::nullopt;
  const int steps = static_cast<int>(std::lround(duration / step)),
            every = static_cast<int>(std::lround(kSample / step));
  Run run{};
  const double start = cpu_time();
  for (int i = 1; i <= steps; ++i) {
    motion.center += step * motion.velocity;
    motion.spin += step * motion.spin_rate;
    const auto hub = tire.advance(motion, road, i * step, step);
    if (!hub) return std::nullopt;
    if (i % every != 0) continue;
    run.Fx.push_back(hub->force.x());
    run.Fz.push_back(hub->force.z());
  }
  run.time = (cpu_time() - start) / duration;
  return run;
}

double rms(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

}  // namespace

void kerb_rows(Table& table, const RingRounds& rounds) {
  struct Case {
    double height, speed;
    const char* what;
  };
  for (const auto& [height, speed, what] : {Case{-0.025, kSpeed, "60 m/s over a kerb 25 mm deep"},
                                            {0.025, 40.0, "40 m/s over one 25 mm high"}}) {
    const road::ProfileRoad road = kerb(height);
    const auto refined =
        roll(ring_of(320, 20, 10), {.tolerance = 1e-2}, road, speed, 2.5e-5, rounds.duration);
    const auto coarse = roll(ring_of(80, 50, 10), {}, road, speed, 5e-4, rounds.duration);
    auto ring = roll(small_ring(), {}, road, speed, kStep, rounds.duration);
    if (!refined || !coarse || !ring)
      return table.row("ring over a kerb", "no state", "runs", false);
    for (int round = 1; round < rounds.count; ++round)
      ring->time =
          std::min(ring->time, roll(small_ring(), {}, road, speed, kStep, rounds.duration)->time);
    const std::string name = fmt::format("48 segments x 8 blocks x 6 lines, 0.2 ms, {}", what);
    const std::string time = fmt::format("{:.3f} x real time", ring->time);
    if (speed == kSpeed)
      table.full_row(name, time, "<= 0.2", ring->time <= 0.2);
    else
      table.note(name, time);
    const double Fx = rms(ring->Fx, refined->Fx), Fz = rms(ring->Fz, refined->Fz);
    const double of_Fx = Fx / rms(coarse->Fx, refined->Fx),
                 of_Fz = Fz / rms(coarse->Fz, refined->Fz);
    table.full_row("off the refined solution (rms): Fx, Fz, of those of 80 x 50 x 10 at 0.5 ms",
                   fmt::format("{:.0f}, {:.0f} N, {:.2f}, {:.2f}", Fx, Fz, of_Fx, of_Fz),
                   "<= 1",
                   of_Fx <= 1.0 && of_Fz <= 1.0);
  }
}

void car_row(Table& table, const RingRounds& rounds) {
  const road::ProfileRoad road = kerb();
  double least = 1e9;
  for (int round = 0; round < rounds.count; ++round) {
    RingTire tire(small_ring());  // one model with its work memory, used for four states in turn
    std::vector<RingState> states;
    std::vector<WheelMotion> motions;
    for (int i = 0; i < 4; ++i) {
      motions.push_back(rolling(tire, kSpeed));
      motions.back().center += Eigen::Vector3d(i < 2 ? 0.0 : -2.6, i % 2 == 0 ? 0.0 : 1.6, 0.0);
      if (!tire.settle(motions.back(), road, 0.0)) return table.row("car", "stands", "no", false);
      states.push_back(tire.state());
    }
    const int steps = static_cast<int>(std::lround(rounds.duration / kStep));
    const double start = cpu_time();
    for (int i = 1; i <= steps; ++i)
      for (std::size_t k = 0; k < states.size(); ++k) {
        motions[k].center += kStep * motions[k].velocity;
        motions[k].spin += kStep * motions[k].spin_rate;
        auto trial = tire.trial(states[k], motions[k], road, i * kStep, kStep);
        if (!trial) return table.row("four rings at 5 kHz", "no state found", "runs", false);
        states[k] = std::move(trial->state);
      }
    least = std::min(least, (cpu_time() - start) / rounds.duration);
  }
  table.full_row("four rings at 5 kHz and 60 m/s, two over the kerb, two beside it, one core",
                 fmt::format("real time x {:.2f}", 1.0 / least),
                 ">= 1.5",
                 1.0 / least >= 1.5);
}

namespace {

/// Results over the time steps on the kerb: the errors of the derivatives compared with differences
/// of trials, in ascending order, and the CPU time of all steps with and without derivatives. Empty
/// if a step has no solution.
struct SlopeRun {
  std::vector<double> off;
  double with = 1e9, without = 1e9;
};

SlopeRun slopes_over(const road::Road& road, const RingParameters& ring, const RingRounds& rounds) {
  RingTire tire(ring);
  SlopeRun run;
  for (int round = 0; round < rounds.count; ++round) {
    WheelMotion motion = rolling(tire, kSpeed);
    if (!tire.settle(motion, road, 0.0)) return {};
    RingState state = tire.state();
    double time[2] = {0.0, 0.0};
    for (int i = 1; i <= std::lround(rounds.duration / kStep); ++i) {
      motion.center += kStep * motion.velocity;
      motion.spin += kStep * motion.spin_rate;
      if (round == 0)
        run.off.push_back(
            slopes_off_differences(ring, kUntilRounding, state, motion, road, i * kStep, kStep));
      for (const bool slopes : {true, false}) {
        const double start = cpu_time();
        const auto trial = tire.trial(state, motion, road, i * kStep, kStep, slopes);
        time[slopes] += cpu_time() - start;
        if (!trial || trial->slopes.has_value() != slopes) return {};
        if (!slopes) state = trial->state;
      }
    }
    run.without = std::min(run.without, time[0]);
    run.with = std::min(run.with, time[1]);
  }
  std::sort(run.off.begin(), run.off.end());
  return run;
}

}  // namespace

void slopes_rows(Table& table, const RingRounds& rounds) {
  const road::ProfileRoad road = kerb();
  const SlopeRun fine = slopes_over(road, ring_of(60, 8, 6), {1, rounds.duration}),
                 run = slopes_over(road, small_ring(), rounds);
  if (fine.off.empty() || run.off.empty())
    return table.row("slopes of trials", "no state found", "runs", false);
  const auto worst = [](const std::vector<double>& off) {
    return fmt::format("{:.1e}, median {:.1e}", off.back(), off[off.size() / 2]);
  };
  table.row("∂force/∂motion against differences of trials, the first kerb, 60 x 8 x 6",
            worst(fine.off),
            "<= 1e-5",
            fine.off.back() <= 1e-5);
  // A derivative is one-sided if a tread block is about to touch or to slip (motion_slopes.h), so a
  // few errors are large.
  const auto kinks =
      std::count_if(run.off.begin(), run.off.end(), [](double x) { return x > 1e-5; });
  table.note("the same, 48 x 8 x 6",
             fmt::format("{}, {} of {} beyond 1e-5", worst(run.off), kinks, run.off.size()));
  table.note("a trial with ∂force/∂motion, 14 columns",
             fmt::format("{:.2f} x one without, {:.0f} us",
                         run.with / run.without,
                         1e6 * run.with / static_cast<double>(run.off.size())));
}

namespace {

enum class Told { all, height, nothing };

/// Returns the CPU time, s, of rolling with the given parts of the wheel's motion prescribed;
/// nothing if a time step has no solution.
std::optional<double> roll_free(const road::Road& road, Told told, const RingRounds& rounds) {
  RingTire tire(small_ring());
  WheelMotion motion = rolling(tire, kSpeed);
  const auto stands = tire.settle(motion, road, 0.0);
  if (!stands) return std::nullopt;
  FreeWheel wheel;
  if (told != Told::all)
    wheel.spin = {.inertia = 1.0,
                  .place = motion.spin,
                  .rate = motion.spin_rate,
                  .acceleration = stands->moment.y()};
  if (told == Told::nothing)
    wheel.height = {.inertia = 300.0,
                    .place = motion.center.z(),
                    .push = [load = stands->force.z()](double, double) {
                      return Push{-load, 0.0};
                    }};
  const int steps = static_cast<int>(std::lround(rounds.duration / kStep));
  const double start = cpu_time();
  for (int i = 1; i <= steps; ++i) {
    motion.center.x() += kStep * motion.velocity.x();
    if (told == Told::all) motion.spin += kStep * motion.spin_rate;
    const bool runs =
        told == Told::all
            ? static_cast<bool>(tire.advance(motion, road, i * kStep, kStep))
            : static_cast<bool>(tire.advance_free(motion, wheel, road, i * kStep, kStep));
    if (!runs) return std::nullopt;
  }
  return cpu_time() - start;
}

}  // namespace

void free_wheel_rows(Table& table, const RingRounds& rounds) {
  const road::ProfileRoad road = kerb();
  double least[3] = {1e9, 1e9, 1e9};
  for (int round = 0; round < rounds.count; ++round)
    for (const Told told : {Told::all, Told::height, Told::nothing}) {
      const auto time = roll_free(road, told, rounds);
      if (!time) return table.row("free wheel over the kerb", "no state found", "runs", false);
      double& best = least[static_cast<int>(told)];
      best = std::min(best, *time);
    }
  for (const Told told : {Told::height, Told::nothing}) {
    const double ratio = least[static_cast<int>(told)] / least[0];
    table.full_row(told == Told::height ? "a step with a free wheel, over that kerb"
                                        : "the same with a free axle of 300 kg as well",
                   fmt::format("{:.3f} x one whose motion is told", ratio),
                   "<= 1.15",
                   ratio <= 1.15);
  }
}

void bottoming_rows(Table& table, const RingRounds& rounds) {
  const road::ProfileRoad road = kerb();
  for (const RingParameters& linear : {small_ring(), ring_of(80, 50, 10)}) {
    std::vector<double> least(3, 1e9);
    for (int round = 0; round < rounds.count; ++round)
      for (std::size_t i = 0; i < least.size(); ++i) {
        RingParameters ring = linear;
        ring.tread.bottoming = std::array{0.0, 1.0, 0.35}[i];
        const auto run = roll(ring, {}, road, kSpeed, kStep, rounds.duration);
        if (!run) return table.row("tread that bottoms out", "no state found", "runs", false);
        least[i] = std::min(least[i], run->time);
      }
    table.note(fmt::format("tread that bottoms out at 1 and 0.35 of its height, {} x {} x {}",
                           linear.nodes,
                           linear.tread.blocks,
                           linear.tread.lines),
               fmt::format("{:.2f}, {:.2f} x the time of linear rubber",
                           least[1] / least[0],
                           least[2] / least[0]));
  }
}

void drum_row(Table& table, const RingRounds& rounds) {
  constexpr double kRolling = 60.0 / 3.6;
  const road::DrumRoad drum({.diameter = 2.5, .surface = kRolling});
  const road::PlaneRoad flat;
  const RingParameters ring = ring_of(100, 12, 10);
  double on_drum = 1e9, on_flat = 1e9;
  for (int round = 0; round < rounds.count; ++round) {
    const auto a = roll(ring, {}, drum, kRolling, kStep, rounds.duration, true);
    const auto b = roll(ring, {}, flat, kRolling, kStep, rounds.duration);
    if (!a || !b) return table.row("drum", "no state found", "runs", false);
    on_drum = std::min(on_drum, a->time);
    on_flat = std::min(on_flat, b->time);
  }
  table.full_row("drum in place of a flat road, 100 x 12 x 10, 0.2 ms",
                 fmt::format("{:.2f} x the time", on_drum / on_flat),
                 "<= 1.2",
                 on_drum <= 1.2 * on_flat);
}

}  // namespace latsch::benchmarks
