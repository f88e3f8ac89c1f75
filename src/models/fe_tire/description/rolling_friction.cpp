// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/description/rolling_friction.h"

#include <cmath>

namespace latsch::fe_tire {

double RollingFriction::at(double p, double w) const {
  double mu = at_rest;
  if (a != 0.0 && p > 0.0) mu *= std::pow(p / p_0, -a);
  if (peak > 0.0 && w > 0.0) {
    const double log = std::log(w / peak_speed) / width;
    mu *= 1.0 + (peak - 1.0) * std::exp(-log * log);
  }
  return mu;
}

double RollingFriction::limit_slope(double p, double w) const { return (1.0 - a) * at(p, w); }

}  // namespace latsch::fe_tire
