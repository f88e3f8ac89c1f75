// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/rolling/rolling_case.h"

#include <cmath>

namespace latsch::fe_tire {

RollingCase between(const RollingCase& a, const RollingCase& b, double share) {
  RollingCase at = b;
  const auto mean = [share](double from, double to) { return from + share * (to - from); };
  at.speed = mean(a.speed, b.speed);
  at.slip_angle = mean(a.slip_angle, b.slip_angle);
  at.camber = mean(a.camber, b.camber);
  at.turn_slip = mean(a.turn_slip, b.turn_slip);
  at.curvature = mean(a.curvature, b.curvature);
  at.height = mean(a.height, b.height);
  at.spin = mean(a.spin, b.spin);
  if (a.load && b.load) at.load = mean(*a.load, *b.load);
  if (a.drive && b.drive) at.drive = mean(*a.drive, *b.drive);
  return at;
}

double RollingState::loaded_radius() const { return of.height / std::cos(of.camber); }

}  // namespace latsch::fe_tire
