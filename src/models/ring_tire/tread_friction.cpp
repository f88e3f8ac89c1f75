// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/tread_friction.h"

#include <limits>

namespace latsch::ring_tire {

FrictionLaw::FrictionLaw(const TreadFriction& friction)
    : lowest_(friction.pressure[0]), highest_(friction.pressure[2]) {
  const auto through = [&](const std::array<double, 3>& mu) {
    const double p0 = friction.pressure[0], p1 = friction.pressure[1], p2 = friction.pressure[2];
    const double s01 = (mu[1] - mu[0]) / (p1 - p0), s12 = (mu[2] - mu[1]) / (p2 - p1);
    const double c2 = (s12 - s01) / (p2 - p0), c1 = s01 - c2 * (p0 + p1);
    return Quadratic{mu[0] - p0 * (c1 + p0 * c2), c1, c2};
  };
  at_[0] = adhesion_ = through(friction.adhesion);
  at_[1] = through(friction.maximum);
  at_[2] = through(friction.sliding);
  at_[3] = through(friction.blocking);
  speed_[0] = 0.0;
  speed_[1] = friction.maximum_speed;
  speed_[2] = friction.sliding_speed;
  speed_[3] = friction.blocking_speed;
}

FrictionLaw::AtPressure FrictionLaw::at_pressure(double p) const {
  const double inside = clamped(p);
  return {{coefficient(at_[0], inside),
           coefficient(at_[1], inside),
           coefficient(at_[2], inside),
           coefficient(at_[3], inside)}};
}

double FrictionLaw::mu(double v, double p) const {
  const AtPressure at = at_pressure(p);
  for (int i = 0; i < 3; ++i)
    if (v < speed_[i + 1])
      return at.mu[i] + (at.mu[i + 1] - at.mu[i]) * (v - speed_[i]) / (speed_[i + 1] - speed_[i]);
  return at.mu[3];
}

double FrictionLaw::sliding_speed(
    double T, double slope, double Fn, double p, double factor) const {
  const AtPressure at = at_pressure(p);
  const double F = factor * Fn;
  if (T <= at.mu[0] * F) return 0.0;
  for (int i = 0; i < 3; ++i) {
    const double rise = F * (at.mu[i + 1] - at.mu[i]) / (speed_[i + 1] - speed_[i]);
    const double excess = T - slope * speed_[i] - at.mu[i] * F;  // > 0 at the piece's beginning
    const double v = excess / (slope + rise);
    if (slope + rise > 0.0 && speed_[i] + v <= speed_[i + 1]) return speed_[i] + v;
  }
  return (T - at.mu[3] * F) / slope;
}

}  // namespace latsch::ring_tire
