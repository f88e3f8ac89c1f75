// SPDX-License-Identifier: Apache-2.0
// Implements Tire::advance_free for a tire whose steps are cheap and whose state is copied with it.
// The step is repeated from the same state with different wheel speeds, which Broyden's method
// finds from the residuals of the previous trials. In a short step the wheel's inertia dominates,
// so two or three trials suffice.
#pragma once

#include <fmt/format.h>

#include "models/tire/free_wheel.h"

namespace latsch {

template <class T>
Result<HubForces> advance_by_trials(
    T& tire, WheelMotion& motion, FreeWheel& wheel, const road::Road& road, double time, double h) {
  constexpr int kMost = 30;
  // Convergence tolerance: residual relative to the force on the hub (times the radius for the
  // spin).
  constexpr double kClose = 1e-7;
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
    // Broyden's update is the smallest change of the Jacobian with which the last trial would have
    // been predicted correctly.
    const Pair way = 0.5 * h * (rates - last_rates);
    if (way.squaredNorm() > 0.0)
      stiffness -= (of_tire - last_T + stiffness * way) * way.transpose() / way.squaredNorm();
    last_rates = rates;
    last_T = of_tire;
    auto next = wheel.balanced(time, h, rates, of_tire, stiffness);
    // The Jacobian's estimate is from the other side of a kink: start again without it.
    if (!next) {
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
