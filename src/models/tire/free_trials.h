// SPDX-License-Identifier: Apache-2.0
// Tire::advance_free for a tire whose steps are cheap and whose state is copied with it. Steps are
// tried from the same state, at rates that Broyden's method derives from the residuals of the last
// ones. In a short step the wheel's inertia dominates, so two or three trials suffice.
#pragma once

#include <fmt/format.h>

#include "models/tire/free_wheel.h"

namespace latsch {

template <class T>
Result<HubForces> advance_by_trials(
    T& tire, WheelMotion& motion, FreeWheel& wheel, const road::Road& road, double time, double h) {
  constexpr int kMost = 30;
  constexpr double kClose = 1e-7;  // share of the force on the hub, at the radius for the spin
  using Pair = FreeWheel::Pair;
  const T before = tire;
  FreeWheel::Matrix stiffness = FreeWheel::Matrix::Zero();
  Pair rates = wheel.guess(h), last_rates = rates, last_T = Pair::Zero();
  for (int i = 0; i < kMost; ++i) {
    if (i > 0) tire = before;
    const WheelMotion there = wheel.moved(motion, h, rates);
    const Result<HubForces> hub = tire.advance(there, road, time, h);
    if (!hub) {
      tire = before;
      return hub;
    }
    const Pair of_tire = FreeWheel::forces(*hub, there), left = wheel.left(time, h, rates, of_tire);
    const double close = kClose * (1.0 + hub->force.norm());
    if (std::abs(left[0]) <= close * tire.free_radius() && std::abs(left[1]) <= close) {
      wheel = wheel.after(time, h, rates, of_tire);
      motion = there;
      return hub;
    }
    // Broyden's update is the least change with which the last trial would have been predicted.
    const Pair way = 0.5 * h * (rates - last_rates);
    if (way.squaredNorm() > 0.0)
      stiffness -= (of_tire - last_T + stiffness * way) * way.transpose() / way.squaredNorm();
    last_rates = rates;
    last_T = of_tire;
    auto next = wheel.balanced(time, h, rates, of_tire, stiffness);
    if (!next) {  // the estimate is from a kink: start again
      stiffness.setZero();
      next = wheel.balanced(time, h, rates, of_tire, stiffness);
    }
    if (!next || !next->allFinite()) break;
    rates = *next;
  }
  tire = before;
  return Failure{fmt::format(
      "no speed of the free wheel was found in the step to {:.5f} s; a shorter step may help",
      time)};
}

}  // namespace latsch
