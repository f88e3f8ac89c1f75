// SPDX-License-Identifier: Apache-2.0
// CPU time of steady rolling with friction, on tire B as shipped (in a smoke run on a coarse mesh).
// Times of one state are compared with that of a pressed state of the same run: the inflated tire,
// pressed by 20 mm on its whole ring in one step. A first state goes from there to the free wheel
// under the load found; a next state is one of a sweep of slip angles.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "cpu_time.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/rolling/rolling_tire.h"
#include "models/fe_tire/slopes/tire_slopes.h"
#include "shipped_tires.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

using namespace fe_tire;

constexpr double kDeflection = 0.020, kSpeed = 20.0;  // m, m/s
constexpr double kDegree = std::numbers::pi / 180.0;

/// Measures the CPU time of what it is given.
class Stopwatch {
 public:
  double lap() {
    const double now = cpu_seconds(), taken = now - before_;
    before_ = now;
    return taken;
  }

 private:
  double before_ = cpu_seconds();
};

/// The free wheel, braked or at a slip angle.
RollingCase slipping(const RollingState& free, double kappa, double alpha) {
  RollingCase of = free.of;
  of.drive.reset();
  of.slip_angle = alpha;
  of.speed = kSpeed / std::cos(alpha);
  of.spin = (1.0 + kappa) * free.of.spin;
  return of;
}

std::string work(const RollingState& state, double seconds) {
  return fmt::format("{:.2f} s CPU: {} iterations, {} factors, {} solutions of the patch, {} parts",
                     seconds,
                     state.iterations,
                     state.factors,
                     state.passes,
                     state.parts);
}

struct Sweep {
  double seconds = 0.0, longest = 0.0;
  int states = 0, failed = 0;
  std::string work;  // the counts of the longest state
};

/// Goes from the free wheel through slips, from neighbor to neighbor.
Sweep sweep(RollingTire& rolling, const RollingState& free, const std::vector<RollingCase>& cases) {
  Sweep all;
  RollingState from = free;
  for (const RollingCase& of : cases) {
    Stopwatch watch;
    const auto state = rolling.roll(from, of);
    const double seconds = watch.lap();
    all.seconds += seconds;
    ++all.states;
    if (!state) {
      ++all.failed;
      all.work = state.failure().reason;
      continue;
    }
    if (seconds > all.longest) {
      all.longest = seconds;
      all.work = work(*state, seconds);
    }
    from = *state;
  }
  return all;
}

std::vector<RollingCase> slip_angles(const RollingState& free, int count, double most) {
  std::vector<RollingCase> cases;
  for (int k = 1; k <= count; ++k) cases.push_back(slipping(free, 0.0, most * k / count));
  return cases;
}

std::vector<RollingCase> slips(const RollingState& free, int count, double most) {
  std::vector<RollingCase> cases;
  for (int k = 1; k <= count; ++k) cases.push_back(slipping(free, -most * k / count, 0.0));
  return cases;
}

/// Ten numbers of the tire, each changed by a hundred-thousandth to either side: moduli and
/// densities of its rubbers, moduli and angles of its plies, the pressure.
std::vector<Variation> ten_numbers(const TireDescription& description) {
  constexpr double kStep = 1e-5;
  std::vector<std::function<void(TireDescription&, double)>> numbers;
  for (std::size_t k = 0; k < description.rubbers.size(); ++k) {
    numbers.emplace_back([k](TireDescription& tire, double by) {
      Hyperelastic& law = tire.rubbers[k].law;
      for (double* modulus : {&law.C10, &law.C01, &law.K}) *modulus *= by;
    });
    numbers.emplace_back([k](TireDescription& tire, double by) { tire.rubbers[k].density *= by; });
  }
  for (std::size_t k = 0; k < description.plies.size(); ++k) {
    numbers.emplace_back(
        [k](TireDescription& tire, double by) { tire.plies[k].cords.E_tension *= by; });
    numbers.emplace_back(
        [k](TireDescription& tire, double by) { tire.plies[k].cords.angle *= by; });
  }
  for (std::size_t k = 0; k < description.plies.size(); ++k)
    numbers.emplace_back(
        [k](TireDescription& tire, double by) { tire.plies[k].cords.density *= by; });
  numbers.resize(std::min<std::size_t>(numbers.size(), 9));
  numbers.emplace_back([](TireDescription& tire, double by) { tire.pressure *= by; });
  std::vector<Variation> variations;
  for (const auto& number : numbers) {
    const auto varied = [&](double by) {
      TireDescription tire = description;
      number(tire, by);
      return VariedTire{build_mesh(tire), build_materials(tire), tire.pressure, tire.friction};
    };
    variations.push_back(
        {varied(1.0 - kStep), varied(1.0 + kStep), kStep, &number == &numbers.back()});
  }
  return variations;
}

std::string times(double seconds, double pressed) {
  return fmt::format("{:.2f} s, {:.2f} x", seconds, seconds / pressed);
}

/// Measures slopes of a state with a slip angle beside the mean CPU time of such a state.
void slope_rows(Table& table,
                FeTire& tire,
                const TireDescription& description,
                RollingTire& rolling,
                const RollingState& free,
                double of_state) {
  const RollingState state = value_of(rolling.roll(free, slipping(free, 0.0, 2.0 * kDegree)));
  Stopwatch watch;
  TireSlopes slopes(tire, ten_numbers(description));
  table.note("elements with other numbers, once a trial", fmt::format("{:.2f} s", watch.lap()));
  const std::vector<TireSlopes::RollsWith> with(slopes.variables());
  (void)value_of(slopes.of_rolling(rolling, state, with, true));
  const double of_slopes = watch.lap();
  table.full_row(fmt::format("slopes of a state's forces in {} numbers, over a next state, mean",
                             slopes.variables()),
                 fmt::format("{:.2f} s, {:.2f} x", of_slopes, of_slopes / of_state),
                 "<= 2 x",
                 of_slopes <= 2.0 * of_state);
}

}  // namespace

int run(const Options& options) {
  Table table("rolling_cost", options);
  const TireDescription description = tire_for(options, "passenger_225_50R16");
  Stopwatch watch;
  FeTire tire(description);
  const Inflated inflated = value_of(tire.inflate(description.pressure));
  const double inflation = watch.lap();
  const TireState above = tire.over(inflated, {}, FeTire::Poses::any);
  const double symbolic = watch.lap();
  const TireState pressed =
      value_of(tire.advance(above, {FeTire::below(inflated, kDeflection)})).back();
  const double press = watch.lap();
  table.note("unknowns of the whole ring", fmt::format("{}", tire.mesh().free_dofs()));
  table.note("inflation, and order of elimination",
             fmt::format("{:.2f} s, {:.2f} s", inflation, symbolic));
  table.note("a pressed state, whole ring", fmt::format("{:.2f} s", press));

  RollingTire rolling(tire);
  const RollingState start = rolling.start(pressed);
  const double prepare = watch.lap();
  table.note("preparation of the tire that rolls", times(prepare, press));
  RollingCase of;
  of.speed = kSpeed;
  of.height = start.of.height;
  of.spin = kSpeed / (inflated.radius - kDeflection / 3.0);
  of.load = start.forces.force.z();
  of.friction.at_rest = 0.0;
  const RollingState smooth = value_of(rolling.roll(start, of));
  const double frictionless = watch.lap();
  table.full_row("a state without friction",
                 times(frictionless, press),
                 "<= 1.3 x",
                 frictionless <= 1.3 * press);
  table.note("its work", work(smooth, frictionless));
  rolling.forget();

  watch.lap();
  of.friction.at_rest = 1.0;
  of.drive = 0.0;
  const RollingState free = value_of(rolling.roll(start, of));
  const double first = watch.lap();
  table.full_row("a first state with friction, the free wheel",
                 times(first, press),
                 "<= 8 x",
                 first <= 8.0 * press);
  table.note("its work", work(free, first));
  table.row("load of the free wheel, relative error",
            fmt::format("{:.1e}", free.forces.force.z() / *of.load - 1.0),
            "<= 1e-6",
            std::abs(free.forces.force.z() / *of.load - 1.0) <= 1e-6);

  const int count = options.size(30, 3);
  const Sweep angles = sweep(rolling, free, slip_angles(free, count, 10.0 * kDegree));
  table.row(fmt::format("{} slip angles up to 10 deg: states not found", count),
            fmt::format("{}", angles.failed),
            "0",
            angles.failed == 0);
  table.full_row("a next state of these, mean",
                 times(angles.seconds / angles.states, press),
                 "<= 0.8 s",
                 angles.seconds / angles.states <= 0.8);
  table.note("the longest", angles.work);
  const double whole = inflation + symbolic + press + prepare + first + angles.seconds;
  table.full_row("the sweep of slip angles, from inflation",
                 fmt::format("{:.1f} s", whole),
                 "<= 25 s",
                 whole <= 25.0);
  const Sweep braked = sweep(rolling, free, slips(free, options.size(20, 3), 0.2));
  table.row(fmt::format("{} slips down to -0.2: states not found", braked.states),
            fmt::format("{}", braked.failed),
            "0",
            braked.failed == 0);
  table.full_row("a next state of these, mean",
                 times(braked.seconds / braked.states, press),
                 "<= 0.8 s",
                 braked.seconds / braked.states <= 0.8);
  table.note("the longest", braked.work);
  slope_rows(table, tire, description, rolling, free, angles.seconds / angles.states);
  return table.exit_code();
}

}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  return latsch::benchmarks::run_benchmark(argc, argv, {}, latsch::benchmarks::run);
}
