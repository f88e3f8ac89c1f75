// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/tread_friction.h"

namespace latsch::ring_tire {

FrictionLaw::FrictionLaw(const TreadFriction& friction)
    : lowest_(friction.pressure[0]), highest_(friction.pressure[2]) {
  const auto through = [&](const std::array<double, 3>& mu) {
    const double p0 = friction.pressure[0], p1 = friction.pressure[1], p2 = friction.pressure[2];
    const double s01 = (mu[1] - mu[0]) / (p1 - p0), s12 = (mu[2] - mu[1]) / (p2 - p1);
    const double c2 = (s12 - s01) / (p2 - p0), c1 = s01 - c2 * (p0 + p1);
    return Quadratic{mu[0] - p0 * (c1 + p0 * c2), c1, c2};
  };
  at_[0] = through(friction.adhesion);
  at_[1] = through(friction.maximum);
  at_[2] = through(friction.sliding);
  at_[3] = through(friction.blocking);
  speed_[0] = 0.0;
  speed_[1] = friction.maximum_speed;
  speed_[2] = friction.sliding_speed;
  speed_[3] = friction.blocking_speed;
}

double FrictionLaw::mu(double v, double p) const {
  const double inside = clamped(p);
  for (int i = 0; i < 3; ++i)
    if (v < speed_[i + 1]) {
      const double mu = coefficient(at_[i], inside), next = coefficient(at_[i + 1], inside);
      return mu + (next - mu) * (v - speed_[i]) / (speed_[i + 1] - speed_[i]);
    }
  return coefficient(at_[3], inside);
}

}  // namespace latsch::ring_tire
