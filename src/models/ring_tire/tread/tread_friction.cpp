// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/tread/tread_friction.h"

#include <algorithm>

namespace latsch::ring_tire {
namespace {

double coefficient(const FrictionLaw::Quadratic& q, double p) {
  return q.c0 + p * (q.c1 + p * q.c2);
}

}  // namespace

FrictionLaw::FrictionLaw(const TreadFriction& friction) {
  table_.lowest = friction.pressure[0];
  table_.highest = friction.pressure[2];
  const auto through = [&](const std::array<double, 3>& mu) {
    const double p0 = friction.pressure[0], p1 = friction.pressure[1], p2 = friction.pressure[2];
    const double s01 = (mu[1] - mu[0]) / (p1 - p0), s12 = (mu[2] - mu[1]) / (p2 - p1);
    const double c2 = (s12 - s01) / (p2 - p0), c1 = s01 - c2 * (p0 + p1);
    return Quadratic{mu[0] - p0 * (c1 + p0 * c2), c1, c2};
  };
  table_.at[0] = through(friction.adhesion);
  table_.at[1] = through(friction.maximum);
  table_.at[2] = through(friction.sliding);
  table_.at[3] = through(friction.blocking);
  table_.speed[0] = 0.0;
  table_.speed[1] = friction.maximum_speed;
  table_.speed[2] = friction.sliding_speed;
  table_.speed[3] = friction.blocking_speed;
  for (int i = 0; i < 3; ++i) table_.over_range[i] = 1.0 / (table_.speed[i + 1] - table_.speed[i]);
}

double FrictionLaw::mu(double v, double p) const {
  const double inside = std::clamp(p, table_.lowest, table_.highest);
  for (int i = 0; i < 3; ++i)
    if (v < table_.speed[i + 1]) {
      const double mu = coefficient(table_.at[i], inside),
                   next = coefficient(table_.at[i + 1], inside);
      return mu + (next - mu) * (v - table_.speed[i]) / (table_.speed[i + 1] - table_.speed[i]);
    }
  return coefficient(table_.at[3], inside);
}

}  // namespace latsch::ring_tire
