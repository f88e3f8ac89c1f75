// SPDX-License-Identifier: Apache-2.0
// Benchmark of the full-car model, which consists of rigid bodies and bushings: the car drives over
// a kerb. The rows show CPU time over simulated time, the effect of smaller time steps, the order
// of convergence and the energy balance, on spring tires and on flexible ring tires.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "models/car/race_car_testing.h"
#include "models/car/smooth_kerb_testing.h"
#include "models/ring_tire/description/ring_reader.h"
#include "models/ring_tire/ring/ring_tire.h"
#include "models/road/kerb.h"
#include "models/road/plane_road.h"
#include "table.h"
#include "yardstick.h"

namespace {

using namespace latsch;
using namespace latsch::car;
using benchmarks::Table;
using Forces = std::array<double, kCorners>;

constexpr double kSpeed = 60.0, kStep = 2e-4, kDuration = 0.3;  // m/s, s, s
constexpr int kRounds = 15, kRingRounds = 5;

/// A kerb with a pitch of 800 mm and a depth of 25 mm below the left wheels: 75 Hz at 60 m/s.
road::ProfileRoad kerb(road::Kerb::Shape shape, double height = -0.025) {
  return road::kerb_road({.shape = shape,
                          .pitch = 0.8,
                          .width = 0.8,
                          .height = height,
                          .count = 20,
                          .start = {2.0, 0.2}});
}

std::unique_ptr<Car> made(const CarParameters& parameters,
                          const Tires& tires,
                          const multibody::TransientSettings& settings = {}) {
  auto car = Car::make(parameters, tires, {}, settings);
  return car ? std::move(*car) : nullptr;
}

struct Run {
  double time = 0.0;  // CPU time, s
  std::vector<Forces> pushrods;
};

/// Drives the car from the state `from` and records the push-rod forces every `every` steps; 0
/// records none. Returns nothing if a step has no solution.
std::optional<Run> drive(Car& car,
                         const CarState& from,
                         const road::Road& road,
                         double step,
                         double duration,
                         int every) {
  Run run;
  CarState state = from;
  const int steps = static_cast<int>(std::lround(duration / step));
  const double start = benchmarks::cpu_time();
  for (int i = 1; i <= steps; ++i) {
    if (!car.advance(state, step, road, {})) return std::nullopt;
    if (every > 0 && i % every == 0) run.pushrods.push_back(car.pushrod_forces(state));
  }
  run.time = benchmarks::cpu_time() - start;
  return run;
}

/// Returns the mean over the push-rods of rms(a - b) / rms(b - b0), where b0 is the first value of
/// b.
double error(const std::vector<Forces>& a, const std::vector<Forces>& b, const Forces& rest) {
  double mean = 0.0;
  for (std::size_t rod = 0; rod < kCorners; ++rod) {
    double off = 0.0, of = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      off += std::pow(a[i][rod] - b[i][rod], 2);
      of += std::pow(b[i][rod] - rest[rod], 2);
    }
    mean += std::sqrt(off / of) / static_cast<double>(kCorners);
  }
  return mean;
}

void speed_rows(Table& table, int rounds) {
  const road::ProfileRoad road = kerb(road::Kerb::Shape::sine);
  for (const bool locked : {true, false}) {
    const auto car = made(race_car(locked), spring_tires());
    const auto from = car->settle(road, kSpeed, {});
    const std::string what =
        fmt::format("{} bodies, {} bushings, kerb of 0.8 m and 25 mm at 60 m/s, 5 kHz",
                    car->mechanism().bodies().size(),
                    car->mechanism().joints().size());
    if (!from) return table.row(what, from.failure().reason, "runs", false);
    bool runs = true;
    const auto cost = benchmarks::beside(benchmarks::Yardstick::atan, rounds, [&] {
      runs = drive(*car, *from, road, kStep, kDuration, 0).has_value() && runs;
    });
    const double real = kDuration / cost.time;
    const std::string value =
        fmt::format("real time x {:.2f}, a step {}",
                    real,
                    benchmarks::in_units(cost.per(kDuration / kStep), benchmarks::Yardstick::atan));
    if (locked)
      table.full_row(what, value, ">= 8", runs && real >= 8.0);
    else
      table.note(what + ", rockers and springs", value);
  }
}

void refinement_rows(Table& table, double duration) {
  struct Case {
    road::Kerb::Shape shape;
    double height;
    const char* what;
  };
  using Shape = road::Kerb::Shape;
  const auto car = made(race_car(true), spring_tires());
  for (const auto& [shape, height, which] : {Case{Shape::sine, -0.025, "sine, 25 mm deep"},
                                             {Shape::sine, 0.025, "sine, 25 mm high"},
                                             {Shape::saw_tooth, -0.025, "saw-tooth, 25 mm deep"}}) {
    const road::ProfileRoad road = kerb(shape, height);
    const auto from = car->settle(road, kSpeed, {});
    const std::string what =
        fmt::format("push-rod forces at 5 kHz, rms off steps of 1/80 ms, {}", which);
    if (!from) return table.row(what, from.failure().reason, "runs", false);
    const Forces rest = car->pushrod_forces(*from);
    const auto fine = drive(*car, *from, road, kStep / 16, duration, 16);
    std::vector<double> errors;
    for (const int parts : {1, 2}) {
      const auto run = drive(*car, *from, road, kStep / parts, duration, parts);
      if (!run || !fine) return table.row(what, "no solution", "runs", false);
      errors.push_back(error(run->pushrods, fine->pushrods, rest));
    }
    const std::string value =
        fmt::format("{:.3f} % (10 kHz {:.3f} %)", 100 * errors[0], 100 * errors[1]);
    if (shape == Shape::sine && height < 0.0)
      table.row(what, value, "<= 0.3 %", errors[0] <= 0.003);
    else
      table.note(what, value);
  }
}

void order_row(Table& table) {
  const auto car = made(race_car(true), spring_tires());
  const SmoothKerb road;
  const auto from = car->settle(road, 20.0, {});
  std::vector<std::vector<Forces>> forces;
  for (const int parts : {2, 4, 8}) {
    const auto run = from ? drive(*car, *from, road, kStep / parts, 0.25, 5 * parts) : std::nullopt;
    if (!run) return table.row("order", "no solution", "runs", false);
    forces.push_back(run->pushrods);
  }
  const Forces rest = car->pushrod_forces(*from);
  const double order =
      std::log2(error(forces[0], forces[1], rest) / error(forces[1], forces[2], rest));
  table.row("order of push-rod forces, steps of 0.1, 0.05 and 0.025 ms, smooth kerb, tires stay on",
            fmt::format("{:.2f}", order),
            "2 +- 0.15",
            std::abs(order - 2.0) <= 0.15);
}

CarParameters without_damping(CarParameters car) {
  for (Axle* axle : {&car.front, &car.rear}) {
    for (multibody::BushingParameters& bushing : axle->corner.bushings) {
      bushing.damping.setZero();
      bushing.rotational_damping.setZero();
    }
    if (!axle->inboard) continue;
    axle->inboard->unit.damping = 0.0;
    axle->inboard->bearing_damping = 0.0;
  }
  return car;
}

/// Returns the total energy, J, of bodies, springs, weight and tires.
double energy_of(const Car& car, const CarState& state, const multibody::Assembly& assembly) {
  constexpr double kTire = 117e3;  // N/m, stiffness of spring_tires()
  double sum = assembly.kinetic_energy(state.bodies.poses, state.bodies.rates) +
               assembly.potential_energy({.poses = state.bodies.poses});
  for (const double Fz : car.vertical_forces(state)) sum += 0.5 * Fz * Fz / kTire;
  return sum;
}

/// Returns the largest change of the total energy within `duration`, s, relative to the energy of
/// the initial heave and roll velocity. That velocity is the largest at which no tire leaves the
/// road.
double energy_change(bool locked, double step, double duration) {
  const auto car = made(without_damping(race_car(locked)), spring_tires(0.0), {.dissipation = 0.0});
  car->guide.lateral = car->guide.yaw = car->guide.along = 0.0;
  const road::PlaneRoad flat;
  auto state = car->settle(flat, 0.0, {});
  if (!state) return 1e9;
  const multibody::Assembly assembly(car->mechanism());
  const double at_rest = energy_of(*car, *state, assembly);
  const Eigen::Vector3d turning(0.15, 0.05, 0.0);  // rad/s
  const Eigen::Vector3d middle = state->bodies.poses[0].place;
  for (std::size_t i = 0; i < state->bodies.poses.size(); ++i) {
    auto rate = state->bodies.rates.segment<6>(6 * static_cast<Eigen::Index>(i));
    rate << Eigen::Vector3d(0.0, 0.0, 0.08) + turning.cross(state->bodies.poses[i].place - middle),
        turning;
  }
  const double first = energy_of(*car, *state, assembly);
  double worst = 0.0;
  for (int i = 0; i < std::lround(duration / step); ++i) {
    if (!car->advance(*state, step, flat, {})) return 1e9;
    const auto Fz = car->vertical_forces(*state);
    if (*std::min_element(Fz.begin(), Fz.end()) <= 0.0) return 1e9;
    worst = std::max(worst, std::abs(energy_of(*car, *state, assembly) - first));
  }
  return worst / (first - at_rest);
}

void energy_rows(Table& table, double duration) {
  for (const bool locked : {true, false})
    for (const double step : {kStep, 5e-5}) {
      const double change = energy_change(locked, step, duration);
      const std::string what =
          fmt::format("energy without damping, {}, over {} s in steps of {} ms",
                      locked ? "locked" : "springs",
                      duration,
                      1e3 * step);
      const std::string value = fmt::format("{:.1e} of that of the motion", change);
      if (step == kStep)
        table.note(what, value);
      else
        table.row(what, value, "<= 1e-6", change <= 1e-6);
    }
}

/// Returns the race car with its ride height set for tires of this radius, m.
CarParameters on_tires(double radius) {
  CarParameters car = race_car(true);
  const Eigen::Vector3d up(0.0, 0.0, radius - car.front.corner.wheel_center.z());
  car.chassis.body.center += up;
  for (Axle* axle : {&car.front, &car.rear}) {
    for (Eigen::Vector3d& point : axle->corner.points) point += up;
    axle->corner.wheel_center += up;
  }
  return car;
}

void ring_rows(Table& table, const benchmarks::Options& options) {
  auto ring =
      ring_tire::read_ring_tire(Document::read(std::filesystem::path(LATSCH_SOURCE_DIR) /
                                               "studies/ring_tires/passenger_205_55R16.toml")
                                    .root());
  using Shape = road::Kerb::Shape;
  const auto row = [&](int nodes, int blocks, Shape shape) {
    ring.nodes = nodes;
    ring.tread.blocks = blocks;
    const ring_tire::RingTire tire(ring);
    Tires tires;
    for (auto& one : tires) one = tire.clone();
    const std::string what = fmt::format(
        "four rings of {} segments x {} blocks x {} lines under it, {} kerb, 5 kHz, one core",
        nodes,
        blocks,
        ring.tread.lines,
        shape == Shape::triangle ? "triangular" : "sine");
    const auto car = made(on_tires(tire.free_radius()), tires);
    if (!car) return table.row(what, "does not stand", "runs", false);
    const road::ProfileRoad road = kerb(shape);
    const auto from = car->settle(road, kSpeed, {});
    if (!from) return table.row(what, from.failure().reason, "runs", false);
    double least = 1e9;
    for (int round = 0; round < options.size(kRingRounds, 1); ++round) {
      const auto run = drive(*car, *from, road, kStep, options.size(kDuration, 0.04), 0);
      if (!run) return table.row(what, "no solution", "runs", false);
      least = std::min(least, run->time);
    }
    const double real = options.size(kDuration, 0.04) / least;
    const std::string value = fmt::format("real time x {:.2f}", real);
    if (nodes == 48)
      table.full_row(what, value, ">= 1", real >= 1.0);
    else
      table.note(what, value);
  };
  row(48, 8, Shape::triangle);
  if (options.is_smoke()) return;
  row(48, 8, Shape::sine);  // a sine of 256 chords: hardly any tread is above one plane
  row(80, 10, Shape::triangle);
}

int bench(const benchmarks::Options& options) {
  Table table("car", options);
  speed_rows(table, options.size(kRounds, 1));
  refinement_rows(table, options.size(kDuration, 0.06));
  if (!options.is_smoke()) order_row(table);
  energy_rows(table, options.size(1.0, 0.05));
  ring_rows(table, options);
  return table.exit_code();
}

}  // namespace

int main(int argc, char** argv) { return latsch::benchmarks::run_benchmark(argc, argv, {}, bench); }
