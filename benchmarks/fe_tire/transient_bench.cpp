// SPDX-License-Identifier: Apache-2.0
// The finite-element tire in time: accuracy beside CalculiX, beside steady states and beside the
// response in frequency, and the CPU time of a passage over a cleat.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "cpu_time.h"
#include "dropped_wheel.h"
#include "free_wheel.h"
#include "models/fe_tire/description/reference_tires.h"
#include "models/fe_tire/grip/passing_bar.h"
#include "models/fe_tire/passage/rolling_transient.h"
#include "models/fe_tire/passage/tire_in_time.h"
#include "passage_energy.h"
#include "shipped_tires.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

using namespace fe_tire;

constexpr double kLoad = 4000.0, kSpeed = 60.0 / 3.6;  // N, m/s
constexpr double kLoss = 0.15;                         // loss factor of every rubber

std::string percent(double error) { return fmt::format("{:.3f} %", 100.0 * error); }

void dropped_rows(Table& table, const Options& options) {
  constexpr double kStep = 1e-4;                                    // s
  const double end = options.size(verification::kDropEnd, 0.0025);  // s
  for (const bool spins : {false, true}) {
    const auto errors =
        verification::drop_errors(spins, verification::drop_wheel(spins, kStep, end));
    const std::string name = spins ? "drop_spinning_wheel" : "drop_wheel";
    const double most = spins ? 0.05 : 0.02;
    const std::string reach = fmt::format("<= {:g} %", 100.0 * most);
    table.full_row(
        name + ", CalculiX: impulse", percent(errors.impulse), "<= 0.1 %", errors.impulse <= 1e-3);
    table.row(name + ", means of the load over 2 ms, rms",
              percent(errors.load_of_passages),
              reach,
              errors.load_of_passages <= most);
    table.full_row(
        name + ", load every 0.5 ms, rms", percent(errors.load), reach, errors.load <= most);
  }
}

TireDescription relaxing_tire(const Options& options) {
  TireDescription tire = tire_for(options, "passenger_225_50R16");
  for (Rubber& rubber : tire.rubbers)
    rubber.prony = value_of(constant_loss_factor(kLoss, 0.1, 1000.0));
  return tire;
}

/// A passage that begins with the steady state of a free wheel.
RollingTransient passage_of(FreeWheel& wheel, const TireDescription& of) {
  RollingTransient passage(wheel.tire);
  passage.set_history(build_losses(of), wheel.inflated);
  return passage;
}

/// Largest errors of forces and of the moment about the vertical, relative to the largest force and
/// the largest moment of the steady state.
double error_of(const RollingForces& found, const RollingForces& steady) {
  const double force = (found.force - steady.force).cwiseAbs().maxCoeff();
  return std::max(force / steady.force.cwiseAbs().maxCoeff(),
                  std::abs(found.moment.z() / steady.moment.z() - 1.0));
}

void steady_rows(Table& table,
                 const Options& options,
                 FreeWheel& wheel,
                 const TireDescription& of) {
  constexpr double kAngle = 0.03, kSlip = -0.01, kRamp = 0.06;  // rad, 1, s
  const double step = 1e-3, time = options.size(0.5, 0.05);
  // The axle keeps the height of the free wheel.
  RollingCase turned = wheel.at(0.0, kAngle), slower = wheel.at(kSlip, 0.0);
  for (RollingCase* of_wheel : {&turned, &slower}) {
    of_wheel->load.reset();
    of_wheel->height = wheel.state.of.height;
  }
  const RollingState steady = value_of(wheel.rolling.roll(wheel.state, turned));
  RollingTransient passage = passage_of(wheel, of);

  auto now = value_of(passage.start(steady, {.step = 3.3e-4}));
  for (int k = 0; k < 3; ++k) now = value_of(passage.advance({.of = turned}));
  const double moved = (now.ground.force - steady.forces.force).norm() / kLoad;
  table.row("a steady state in the equations of a passage: change of the forces, over the load",
            fmt::format("{:.1e}", moved),
            "<= 1e-5",
            moved <= 1e-5);

  (void)value_of(passage.start(wheel.state, {.step = step, .rho = 0.3}));
  const double begin = cpu_seconds();
  for (long k = 1; k <= std::lround(time / step); ++k) {
    WheelMoment to{.of = turned};
    to.of.slip_angle = kAngle * std::min(1.0, static_cast<double>(k) * step / kRamp);
    to.of.speed = kSpeed / std::cos(to.of.slip_angle);
    to.of.spin = wheel.state.of.spin;
    now = value_of(passage.advance(to));
  }
  const double error = error_of(now.ground, steady.forces);
  table.full_row(
      fmt::format("{:g} s after a new slip angle, largest error of Fx, Fy, Fz, Mz", time),
      percent(error),
      "<= 1 %",
      error <= 1e-2);
  table.note("CPU time of each of these steps",
             fmt::format("{:.0f} ms", 1e3 * step / time * (cpu_seconds() - begin)));

  const RollingState braked = value_of(wheel.rolling.roll(wheel.state, slower));
  now = value_of(passage.start(braked, {.step = step, .rho = 0.3}));
  for (long k = 1; k <= std::lround(time / step); ++k)
    now = value_of(passage.advance({.of = braked.of, .wheel = SpinningWheel{.inertia = 0.5}}));
  const double radius = std::abs(now.spin / wheel.state.of.spin - 1.0);
  table.full_row("effective radius of a wheel that was braked by 1 % and then spins freely",
                 percent(radius),
                 "<= 0.2 %",
                 radius <= 2e-3);
}

struct Record {
  std::vector<double> Fx, Fz;             // N, changes on the hub
  double seconds = 0.0, beginning = 0.0;  // CPU, of the passage and of its start
  int iterations = 0, factors = 0, solutions = 0;
};

/// A passage over a cleat of 20 mm, from 50 ms before it is below the axle.
struct Passage {
  double time;           // s
  double step = 5e-4;    // s
  double smooth = 0.0;   // m, half width of the means; 0: an element's length
  double height = 0.01;  // m
  std::optional<ReductionSettings> reduction = {};
};

Record over_cleat(FreeWheel& wheel, const TireDescription& of, const Passage& how) {
  constexpr double kLead = 0.05, kSample = 5e-4;  // s
  Record record;
  const Mesh& mesh = wheel.tire.mesh();
  const double element = mesh.outer_radius() * mesh.angle(1), step = how.step, time = how.time;
  const GroundWithBar bar(
      {.height = how.height, .length = 0.02, .smooth = how.smooth > 0.0 ? how.smooth : element});
  TireInTime passage(wheel.tire, kTouchingAngle, how.reduction);
  passage.set_history(build_losses(of), wheel.inflated);
  double begin = cpu_seconds();
  const auto still = value_of(passage.start(wheel.state, {.step = step}));
  record.beginning = cpu_seconds() - begin;
  begin = cpu_seconds();
  const double speed = wheel.state.of.speed;
  const long every = std::lround(kSample / step);
  for (long k = 1; k <= std::lround(time / step); ++k) {
    const auto now = value_of(
        passage.advance({.of = wheel.state.of,
                         .ground = &bar,
                         .place = {.way = {speed * (static_cast<double>(k) * step - kLead), 0.0}},
                         .wheel = SpinningWheel{.inertia = 1.0}},
                        step));
    record.iterations += now.iterations;
    record.factors += now.factors;
    record.solutions += now.passes;
    if (k % every != 0) continue;
    record.Fx.push_back(now.force.x() - still.force.x());
    record.Fz.push_back(now.force.z() - still.force.z());
  }
  record.seconds = cpu_seconds() - begin;
  return record;
}

double relative_rms(const std::vector<double>& of, const std::vector<double>& to) {
  double difference = 0.0, size = 0.0;
  for (std::size_t k = 0; k < std::min(of.size(), to.size()); ++k) {
    difference += std::pow(of[k] - to[k], 2);
    size += std::pow(to[k], 2);
  }
  return std::sqrt(difference / size);
}

/// Adds the difference of a reduced tire from the full one.
void compare_rows(Table& table,
                  const std::string& passage,
                  const Record& reduced,
                  const Record& full) {
  for (const auto& [name, of, to] :
       {std::tuple("Fx", &reduced.Fx, &full.Fx), std::tuple("Fz", &reduced.Fz, &full.Fz)}) {
    const double error = relative_rms(*of, *to);
    table.full_row(fmt::format("reduced beside full, {}: rms of {}", passage, name),
                   percent(error),
                   "<= 10 %",
                   error <= 0.1);
  }
}

void cleat_rows(Table& table, const Options& options, FreeWheel& wheel, const TireDescription& of) {
  const double time = options.size(0.25, 0.06);
  const Record record = over_cleat(wheel, of, {.time = time});
  const auto most = [](const std::vector<double>& values) {
    double largest = 0.0;
    for (const double value : values) largest = std::max(largest, std::abs(value));
    return largest;
  };
  table.note("cleat of 10 mm x 20 mm at 60 km/h: largest changes of Fx, Fz",
             fmt::format("{:.0f} N, {:.0f} N", most(record.Fx), most(record.Fz)));
  table.full_row(fmt::format("{:g} s of it in steps of 0.5 ms", time),
                 fmt::format("{:.1f} s CPU", record.seconds),
                 "<= 90 s",
                 record.seconds <= 90.0);
  table.note("its work",
             fmt::format("{} iterations, {} factorizations, {} solutions of the patch",
                         record.iterations,
                         record.factors,
                         record.solutions));
  const auto change = [&](const std::string& what, const Record& other) {
    table.note(what,
               fmt::format("{}, {}",
                           percent(relative_rms(record.Fx, other.Fx)),
                           percent(relative_rms(record.Fz, other.Fz))));
  };
  const ReductionSettings reduction = {.highest = options.size(300.0, 100.0)};
  const Record reduced = over_cleat(wheel, of, {.time = time, .reduction = reduction});
  table.full_row("the same by the reduced tire, set-up apart",
                 fmt::format("{:.1f} s CPU", reduced.seconds),
                 "<= 8 s",
                 reduced.seconds <= 8.0);
  table.note("set-up of the reduced tire", fmt::format("{:.1f} s CPU", reduced.beginning));
  compare_rows(table, "60 km/h, 10 mm", reduced, record);
  if (options.is_smoke()) return;
  change("the same with half the step: rms of the change of Fx, Fz",
         over_cleat(wheel, of, {.time = time, .step = 2.5e-4}));
  const Mesh& mesh = wheel.tire.mesh();
  change(
      "the same with means twice as wide",
      over_cleat(wheel, of, {.time = time, .smooth = 2.0 * mesh.outer_radius() * mesh.angle(1)}));
  constexpr double kShort = 0.12, kLow = 2e-3;  // s, m
  compare_rows(table,
               "60 km/h, 2 mm",
               over_cleat(wheel, of, {.time = kShort, .height = kLow, .reduction = reduction}),
               over_cleat(wheel, of, {.time = kShort, .height = kLow}));
  for (const double speed : {30.0, 80.0}) {
    FreeWheel other(of, {}, kLoad, speed / 3.6, 1.0);
    compare_rows(table,
                 fmt::format("{:g} km/h, 10 mm", speed),
                 over_cleat(other, of, {.time = kShort, .reduction = reduction}),
                 over_cleat(other, of, {.time = kShort}));
  }
}

/// Energy of an elastic tire on smooth ground after a cleat: tire B with few columns.
void energy_rows(Table& table, const Options& options) {
  TireDescription tire =
      options.is_smoke() ? coarse_tire("passenger_225_50R16") : reference_tire_b();
  if (!options.is_smoke()) tire.section.meridional = 13;
  tire.element = ElementKind::solid_shell;
  verification::EnergyPassage passage;
  passage.after = options.size(passage.after, 0.003);
  // The drift in words, and whether it is within a thousandth.
  const auto drift = [&](double step, double rho) -> std::pair<std::string, bool> {
    verification::EnergyPassage other = passage;
    other.step = step;
    other.rho = rho;
    try {
      const double found = verification::drift(verification::energy_after_cleat(tire, other));
      return {percent(found), std::abs(found) <= 1e-3};
    } catch (const std::runtime_error& error) {
      return {error.what(), false};
    }
  };
  const auto [kept, is_kept] = drift(5e-4, 1.0);
  table.full_row("energy after a cleat of 5 mm without friction, rho = 1, 0.5 ms: drift in 10 ms",
                 kept,
                 "<= 0.1 %",
                 is_kept);
  if (options.is_smoke()) return;
  table.note("the same, 0.25 ms", drift(2.5e-4, 1.0).first);
  table.note("rho = 0.7, the default: 0.5 ms, 0.25 ms",
             fmt::format("{}, {}", drift(5e-4, 0.7).first, drift(2.5e-4, 0.7).first));
}

/// The reduced tire alone, without its error: a tenth of the whole bench.
void reduced_rows(Table& table, const Options& options) {
  const TireDescription description = relaxing_tire(options);
  FreeWheel wheel(description, {}, kLoad, kSpeed, 1.0);
  const ReductionSettings reduction = {.highest = options.size(300.0, 100.0)};
  const double time = options.size(0.25, 0.06);
  const Record reduced = over_cleat(wheel, description, {.time = time, .reduction = reduction});
  table.full_row(fmt::format("{:g} s over the cleat by the reduced tire, set-up apart", time),
                 fmt::format("{:.1f} s CPU", reduced.seconds),
                 "<= 8 s",
                 reduced.seconds <= 8.0);
  table.note(
      "its work",
      fmt::format(
          "{} iterations, {} solutions of the patch", reduced.iterations, reduced.solutions));
  table.note("set-up of the reduced tire", fmt::format("{:.1f} s CPU", reduced.beginning));
}

int run(const Options& options) {
  Table table("transient", options);
  if (options.has("--reduced")) {
    reduced_rows(table, options);
    return table.exit_code();
  }
  dropped_rows(table, options);
  energy_rows(table, options);
  const TireDescription description = relaxing_tire(options);
  FreeWheel wheel(description, {}, kLoad, kSpeed, 1.0);
  table.note("unknowns of the whole ring", fmt::format("{}", wheel.tire.mesh().free_dofs()));
  cleat_rows(table, options, wheel, description);
  steady_rows(table, options, wheel, description);
  return table.exit_code();
}

}  // namespace
}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  return latsch::benchmarks::run_benchmark(
      argc,
      argv,
      {{"--reduced", "", "the passage of the reduced tire alone, and nothing else"}},
      latsch::benchmarks::run);
}
