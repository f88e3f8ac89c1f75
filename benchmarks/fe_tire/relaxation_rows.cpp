// SPDX-License-Identifier: Apache-2.0
#include "relaxation_rows.h"

#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "cpu_time.h"
#include "models/fe_tire/passage/rolling_transient.h"
#include "models/fe_tire/rolling/rolling_response.h"
#include "models/fe_tire/rolling/rolling_tire.h"
#include "shipped_tires.h"

namespace latsch::benchmarks {
namespace {

using namespace fe_tire;

constexpr double kPressed = 0.015;     // m
constexpr double kSlowChange = 0.1;    // Hz
constexpr double kSlowestPath = 1e-3;  // rad/m of road, for the relaxation length of slow changes

std::string in_percent(double share) { return fmt::format("{:.4f} %", 100.0 * share); }

RollingState free_wheel(RollingTire& rolling, const RollingState& start, double radius, double V) {
  RollingCase of;
  of.speed = V;
  of.spin = V / radius;
  of.load = start.forces.force.z();
  of.drive = 0.0;
  of.friction.at_rest = 1.0;
  return value_of(rolling.roll(start, of));
}

/// A slip, the step to both sides for its slope, and the force or the moment (3 to 5) that follows.
struct SlopeOfSlip {
  const char* what;
  SlipInput input;
  double step;
  int force;
};

constexpr SlopeOfSlip kSlopes[] = {{"Fy by slip angle", SlipInput::angle, 2e-5, 1},
                                   {"Mz by slip angle", SlipInput::angle, 2e-5, 5},
                                   {"Fx by slip", SlipInput::spin, 2e-5, 0},
                                   {"Fy by camber", SlipInput::camber, 2e-4, 1},
                                   {"Mz by turn slip", SlipInput::turn, 1e-4, 5}};

RollingCase beside(const RollingState& free, SlipInput slip, double by) {
  RollingCase of = free.of;
  of.drive.reset();
  if (slip == SlipInput::angle) {
    of.slip_angle = by;
    of.speed /= std::cos(by);
  }
  if (slip == SlipInput::spin) of.spin *= 1.0 + by;
  if (slip == SlipInput::camber) of.camber = by;
  if (slip == SlipInput::turn) of.turn_slip = by;
  return of;
}

void slope_rows_of_slips(Table& table,
                         RollingTire& rolling,
                         const FeTire& tire,
                         const RollingState& free) {
  const RollingResponse response = value_of(RollingResponse::about(tire, free));
  for (const SlopeOfSlip& slope : kSlopes) {
    const auto at = [&](double by) {
      const RollingForces forces =
          value_of(rolling.roll(free, beside(free, slope.input, by))).forces;
      return slope.force < 3 ? forces.force[slope.force] : forces.moment[slope.force - 3];
    };
    const double steady = (at(slope.step) - at(-slope.step)) / (2.0 * slope.step);
    const SlipResponse slow = response.by(slope.input, kSlowChange, Axle::follows);
    const double found =
        (slope.force < 3 ? slow.force[slope.force] : slow.moment[slope.force - 3]).real();
    const double error = std::abs(found / steady - 1.0);
    table.row(fmt::format("rolling, at 0.1 Hz, slope of the steady force: {}", slope.what),
              in_percent(error),
              "<= 0.5 %",
              error <= 5e-3);
  }
}

/// Side force after a slip angle that rises within few steps, beside the relaxation length of slow
/// changes: sigma is the integral of 1 - F(x)/F over the road for every linear tire.
void rows_of_a_step(Table& table,
                    const Options& options,
                    FeTire& tire,
                    RollingTire& rolling,
                    const RollingState& free,
                    double sigma) {
  constexpr double kAngle = 1e-3;   // rad
  constexpr double kLengths = 5.0;  // relaxation lengths that are rolled
  constexpr int kRising = 4;        // steps in which the slip angle rises
  const double V = free.of.speed, step = options.size(1e-3, 1e-2);
  // Plies that steer give a side force without a slip angle.
  const double begin = free.forces.force.y();
  RollingCase slipping = beside(free, SlipInput::angle, kAngle);
  slipping.load.reset();  // the axle is held
  const double F = value_of(rolling.roll(free, slipping)).forces.force.y() - begin;
  RollingTransient passage(tire);
  value_of(passage.start(free, {.step = step, .rho = 0.3}));
  double length = 0.0, reached = 0.0, before = 0.0;
  const int steps = static_cast<int>(std::lround(kLengths * sigma / (V * step)));
  // Slip angles are those of the ends of the steps, and rise linearly in each.
  const double rising = 0.5 * kRising * V * step;
  for (int k = 1; k <= steps; ++k) {
    WheelMoment to{.of = free.of};
    to.of.slip_angle = kAngle * std::min(1.0, static_cast<double>(k) / kRising);
    to.of.speed = V / std::cos(to.of.slip_angle);
    const double share = (value_of(passage.advance(to)).ground.force.y() - begin) / F;
    length += V * step * (1.0 - 0.5 * (share + before));
    const double level = 1.0 - std::exp(-1.0);
    if (before < level && share >= level)
      reached = V * step * (k - 1 + (level - before) / (share - before)) - rising;
    before = share;
  }
  // After the last step, the rest falls as the first-order lag does.
  length += (1.0 - before) * sigma - rising;
  table.row("rolling in time, a new slip angle: integral of what is left of Fy over the road",
            fmt::format("{:.4f} m, relaxation length {:.4f} m", length, sigma),
            "within 2 %",
            std::abs(length / sigma - 1.0) <= 0.02);
  table.row("the same: road to 63 % of Fy",
            fmt::format("{:.4f} m, {}", reached, in_percent(std::abs(reached / sigma - 1.0))),
            "within 5 %",
            std::abs(reached / sigma - 1.0) <= 0.05);
}

}  // namespace

void relaxation_rows(Table& table, const Options& options, FeTire& tire, const Inflated& inflated) {
  constexpr double kSpeed = 20.0, kSlow = 5.0, kPath = 0.5;  // m/s, m/s, rad/m
  RollingTire rolling(tire);
  const TireState pressed = value_of(tire.advance(tire.over(inflated, {}, FeTire::Poses::any),
                                                  {FeTire::below(inflated, kPressed)}))
                                .back();
  const double radius = inflated.radius - kPressed / 3.0;
  const RollingState start = rolling.start(pressed);
  slope_rows_of_slips(table, rolling, tire, free_wheel(rolling, start, radius, kSpeed));

  const RollingState free = free_wheel(rolling, start, radius, kSlow);
  const double before = cpu_seconds();
  const RollingResponse response = value_of(RollingResponse::about(tire, free));
  const double prepared = cpu_seconds();
  const auto side = [&](double path) {
    return response.by(SlipInput::angle, path * kSlow / (2.0 * std::numbers::pi)).force.y();
  };
  const auto length = [&](double path) {
    return relaxation_length(side(path), path * kSlow / (2.0 * std::numbers::pi), kSlow);
  };
  const double sigma = length(kSlowestPath);
  const double seconds = cpu_seconds() - prepared;
  const std::complex<double> lag(1.0, kPath * length(kPath));
  const double departure = std::abs(side(kPath) * lag / side(0.0) - 1.0);
  table.row("rolling, at 0.5 rad/m of road, first-order lag as of slip_history",
            fmt::format("{} off, relaxation length {:.3f} m", in_percent(departure), length(kPath)),
            "<= 1 %",
            departure <= 1e-2);
  table.note("a frequency of it; the tangent before the first one",
             fmt::format("{:.2f} s CPU, {} unknowns of the patch; {:.1f} s",
                         seconds,
                         response.size(),
                         prepared - before));
  rows_of_a_step(table, options, tire, rolling, free, sigma);
}

}  // namespace latsch::benchmarks
