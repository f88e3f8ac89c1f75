// SPDX-License-Identifier: Apache-2.0
// Slip with relaxation: the carcass connects the contact patch to the rim like a spring, so that
// the slip of the patch lags behind that of the wheel.
//
//   du/dt + |Vx|/sigma u = -Vsx        kappa' = u/sigma                (7.9), (7.11)
//   dv/dt + |Vx|/sigma v = +Vsy        alpha' = atan(v/sigma)          (7.7), (7.10), ISO-W
//   [Pacejka 2012, ch. 7.2]
//
// A step is exact for constant velocities, so any step is stable. At a standstill u and v are the
// deflections of a carcass that sticks, bounded by sliding of the patch (standstill.h).
#pragma once

#include <algorithm>
#include <cmath>

namespace latsch::magic_formula {

/// Returns u after `step` seconds, the solution of du/dt = source - rate u, limited to |u| <=
/// bound.
inline double relaxed(double u, double source, double rate, double bound, double step) {
  // (1 - exp(-rate step)) / rate, also for a rate of 0.
  const double gain = rate * step > 1e-12 ? -std::expm1(-rate * step) / rate : step;
  return std::clamp(u + gain * (source - rate * u), -bound, bound);
}

}  // namespace latsch::magic_formula
