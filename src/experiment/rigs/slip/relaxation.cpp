// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/slip/relaxation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace latsch::experiment {
namespace {

// slip ratio and slip angle, rad: far below the friction limit
constexpr double kSmallSlip = 2e-3, kSmallAngle = 4e-3;
// share of the largest force by which the force of a sweep may lag behind without a warning
constexpr double kMostLag = 0.05;

bool steers(const SlipSweep& sweep) { return sweep.alpha_from != sweep.alpha_to; }

/// Returns the force, N, at each step after the slip has jumped from 0 to a small value.
Result<std::vector<double>> step_response(Tire& tire, const SlipSweep& sweep, double sign) {
  const char* const name = steers(sweep) ? "Fy" : "Fx";
  SlipSweep jump = sweep;
  jump.frames = {AxisFrame::W};
  jump.alpha_from = jump.alpha_to = steers(sweep) ? sign * kSmallAngle : 0.0;
  jump.kappa_from = jump.kappa_to = steers(sweep) ? 0.0 : sign * kSmallSlip;
  // the slip jumps within one step; before the jump the wheel rolls freely until its state is
  // steady
  jump.run_in = 2.0 * sweep.step;
  jump.duration = 4.0 * std::numbers::pi * tire.free_radius() / sweep.speed;
  jump.steady = {name};
  const auto channels = run(tire, jump);
  if (!channels) return channels.failure();
  return (*channels)[name];
}

}  // namespace

Result<SlipRelaxation> relaxation(Tire& tire, const SlipSweep& sweep) {
  const auto plus = step_response(tire, sweep, 1.0);
  if (!plus) return plus.failure();
  const auto minus = step_response(tire, sweep, -1.0);
  if (!minus) return minus.failure();
  const std::size_t count = std::min(plus->size(), minus->size());
  const auto odd = [&](std::size_t i) { return 0.5 * ((*plus)[i] - (*minus)[i]); };
  const double way = sweep.speed * sweep.step;
  const auto turn = static_cast<std::size_t>(
      std::clamp(std::lround(2.0 * std::numbers::pi * tire.free_radius() / way),
                 1L,
                 static_cast<long>(count)));
  double limit = 0.0;
  for (std::size_t i = count - turn; i < count; ++i) limit += odd(i) / static_cast<double>(turn);
  if (limit == 0.0) return SlipRelaxation{};
  SlipRelaxation found{.length = 0.0,
                       .stiffness = limit / (steers(sweep) ? kSmallAngle : kSmallSlip)};
  for (std::size_t i = 0; i < count - turn; ++i) found.length += way * (1.0 - odd(i) / limit);
  return found;
}

std::string lag_in_words(const SlipRelaxation& relaxation, const SlipSweep& sweep, double most) {
  const bool side = steers(sweep);
  const double range = side ? sweep.alpha_to - sweep.alpha_from : sweep.kappa_to - sweep.kappa_from;
  const double rolled = sweep.speed * sweep.duration;
  const double lag = std::abs(range) * std::max(relaxation.length, 0.0) / rolled;
  const double force = std::min(lag * std::abs(relaxation.stiffness), most);
  if (!(lag * std::abs(relaxation.stiffness) > kMostLag * most)) return "";
  const double enough = sweep.duration * lag * std::abs(relaxation.stiffness) / (kMostLag * most);
  return fmt::format(
      "the sweep moves the tire {:.3g} m on, but its forces follow small slips only over a "
      "relaxation length of {:.3g} m: they belong to {} {:.2g}{} earlier in the sweep, so that {} "
      "at slip 0 is off by up to {:.0f} N; duration = \"{:.2g} s\" would leave {:.0f} N",
      rolled,
      relaxation.length,
      side ? "a slip angle" : "a slip",
      side ? lag * 180.0 / std::numbers::pi : lag,
      side ? " deg" : "",
      side ? "Fy" : "Fx",
      force,
      enough,
      kMostLag * most);
}

}  // namespace latsch::experiment
