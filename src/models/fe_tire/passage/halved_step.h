// SPDX-License-Identifier: Apache-2.0
// A step of a tire in time that is made in halves, because it has no equilibrium as a whole.
#pragma once

#include "models/fe_tire/passage/wheel_moment.h"

namespace latsch::fe_tire {

inline constexpr int kMostStepsHalved = 4;

/// Makes two half steps, each of which is halved again if it does not succeed, `halvings` times in
/// all. `step(to, h)` makes a step of h, s, and `now`, which it changes, is the wheel at the end of
/// the last one. After a Failure the tire may have moved.
template <class Step>
Result<TransientForces> in_halves(const Step& step,
                                  const WheelMoment& now,
                                  const WheelMoment& to,
                                  double h,
                                  int halvings = kMostStepsHalved) {
  const auto make = [&](const WheelMoment& wheel) {
    auto half = step(wheel, 0.5 * h);
    return half || halvings == 1 ? half : in_halves(step, now, wheel, 0.5 * h, halvings - 1);
  };
  WheelMoment middle = to;
  middle.of = between(now.of, to.of, 0.5);
  middle.place = between(now.place, to.place, 0.5);
  if (now.load && to.load) middle.load = 0.5 * (*now.load + *to.load);
  const auto half = make(middle);
  if (!half) return half;
  auto end = make(to);
  if (!end) return end;
  end->iterations += half->iterations;
  end->factors += half->factors;
  end->passes += half->passes;
  return end;
}

}  // namespace latsch::fe_tire
