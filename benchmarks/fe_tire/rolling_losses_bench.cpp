// SPDX-License-Identifier: Apache-2.0
// Losses in the equilibrium of the rolling finite-element tire: a disc ring that turns below a
// standing force against an independent program; the free wheel on tire B, whose drag, moment and
// power are three values of the rolling resistance; what the balance of power (E.1) misses, and how
// it falls with the width of sectors; and the CPU time of a first state.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "cpu_time.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/rolling/rolling_losses.h"
#include "models/fe_tire/rolling/rolling_tire.h"
#include "shipped_tires.h"
#include "table.h"
#include "turning_disc.h"

namespace latsch::benchmarks {
namespace {

using namespace fe_tire;

constexpr double kDeflection = 0.020, kSpeed = 20.0;  // m, m/s

std::string percent(double share) { return fmt::format("{:+.3f} %", 1e2 * share); }

void turning_disc(const Options& options, Table& table) {
  double displacement = 0.0, moment = 0.0;
  for (const verification::ListedDisc& listed : verification::listed_discs()) {
    if (options.is_smoke() && listed.sectors > 36) continue;
    const verification::TurnedDisc disc = verification::turned_disc(listed.sectors, listed.tau);
    displacement = std::max(displacement, std::abs(disc.displacement / listed.displacement - 1.0));
    moment = std::max(moment, std::abs(disc.moment / listed.moment - 1.0));
    table.note(fmt::format("turning disc, {} sectors, {:g} ms", listed.sectors, 1e3 * listed.tau),
               fmt::format("{:.4f} um, {:.3f} uN m, {} passes",
                           1e6 * disc.displacement,
                           1e6 * disc.moment,
                           disc.passes));
  }
  table.full_row("turning disc: displacement against the independent program",
                 percent(displacement),
                 "<= 0.2 %",
                 displacement <= 2e-3);
  table.full_row("turning disc: moment against the independent program",
                 percent(moment),
                 "<= 1 %",
                 moment <= 1e-2);
}

/// A free wheel and its powers, W.
struct FreeWheel {
  RollingState state;
  double viscous = 0.0;
  double pressed = 0.0, first = 0.0;  // s, CPU time of the pressed and of the rolling state
  double lost() const { return viscous + state.forces.friction_power; }
  double balance() const { return -state.forces.force.x() * kSpeed - lost(); }
};

FreeWheel free_wheel(TireDescription tire, const PronyTerms& terms) {
  for (Rubber& rubber : tire.rubbers) rubber.prony = terms;
  FreeWheel wheel;
  FeTire fe(tire);
  const Inflated inflated = value_of(fe.inflate(tire.pressure));
  const TireState above = fe.over(inflated, {}, FeTire::Poses::any);
  double before = cpu_seconds();
  const auto lap = [&] {
    const double now = cpu_seconds(), taken = now - before;
    before = now;
    return taken;
  };
  const auto pressed = value_of(fe.advance(above, {FeTire::below(inflated, kDeflection)}));
  wheel.pressed = lap();
  RollingTire rolling(fe);
  const LossMaterials losses = build_losses(tire);
  rolling.set_history(losses, inflated);
  const RollingState start = rolling.start(pressed.back());
  RollingCase of;
  of.speed = kSpeed;
  of.height = start.of.height;
  of.spin = kSpeed / (inflated.radius - kDeflection / 3.0);
  of.load = start.forces.force.z();
  of.drive = 0.0;
  of.friction.at_rest = 1.0;
  lap();
  wheel.state = value_of(rolling.roll(start, of));
  wheel.first = lap();
  wheel.viscous = LossMeter(fe, losses, inflated)
                      .measure(wheel.state.u, wheel.state.alpha, wheel.state.of.spin)
                      .rubber;
  return wheel;
}

std::string work(const FreeWheel& wheel) {
  return fmt::format("{} iterations, {} factors, {} solutions of the patch, {} parts",
                     wheel.state.iterations,
                     wheel.state.factors,
                     wheel.state.passes,
                     wheel.state.parts);
}

void three_values(const FreeWheel& wheel, Table& table) {
  const RollingForces& forces = wheel.state.forces;
  const double drag = -forces.force.x(), by_power = wheel.lost() / kSpeed;
  const double by_moment = -forces.moment.y() / wheel.state.loaded_radius();
  table.note(
      "free wheel: -Fx, -My/R_l, P/V, share of Fz",
      fmt::format(
          "{:.2f}, {:.2f}, {:.2f} N, {:.5f}", drag, by_moment, by_power, drag / forces.force.z()));
  table.note("free wheel: the load acts ahead of the axle by",
             fmt::format("{:.3f} mm", -1e3 * forces.moment.y() / forces.force.z()));
  table.row("free wheel: moment about the axle over Fz R_l",
            fmt::format("{:.1e}", forces.drive / (forces.force.z() * wheel.state.loaded_radius())),
            "<= 1e-6",
            std::abs(forces.drive) <= 1e-6 * forces.force.z() * wheel.state.loaded_radius());
  table.row("free wheel: -My/R_l against -Fx",
            percent(by_moment / drag - 1.0),
            "<= 0.01 %",
            std::abs(by_moment / drag - 1.0) <= 1e-4);
  table.full_row("free wheel: balance of power (E.1), share of F_rr V",
                 percent(wheel.balance() / wheel.lost()),
                 "<= 1 %",
                 std::abs(wheel.balance()) <= 1e-2 * wheel.lost());
}

}  // namespace

int run(const Options& options) {
  Table table("rolling_losses", options);
  turning_disc(options, table);
  const TireDescription tire = tire_for(options, "passenger_225_50R16");
  const PronyTerms three = {{0.15, 1e-3}, {0.15, 1e-2}, {0.15, 1e-1}};
  const FreeWheel first = free_wheel(tire, three);
  table.full_row("first state with friction and three Prony terms, against a pressed state",
                 fmt::format("{:.2f} s, {:.2f} x", first.first, first.first / first.pressed),
                 "<= 8 x",
                 first.first <= 8.0 * first.pressed);
  table.note("its work", work(first));
  three_values(first, table);
  for (const double loss_factor : {0.15, 0.3}) {
    const FreeWheel wheel = free_wheel(tire, *constant_loss_factor(loss_factor, 0.1, 1000.0));
    table.note(fmt::format("loss factor {:g}: time against a pressed state", loss_factor),
               fmt::format("{:.2f} x, {}", wheel.first / wheel.pressed, work(wheel)));
    table.full_row(fmt::format("loss factor {:g}: balance of power, share of F_rr V", loss_factor),
                   percent(wheel.balance() / wheel.lost()),
                   "<= 1 %",
                   std::abs(wheel.balance()) <= 1e-2 * wheel.lost());
    if (options.is_smoke()) break;
  }
  return table.exit_code();
}

}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  return latsch::benchmarks::run_benchmark(argc, argv, {}, latsch::benchmarks::run);
}
