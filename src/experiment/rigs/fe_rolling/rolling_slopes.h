// SPDX-License-Identifier: Apache-2.0
// Characteristic slopes of the finite-element tire at free rolling, by the definitions of
// rigs/slip/rolling_stiffness.h, from pairs of steady states (rolling_rig.h) at a value and at its
// opposite: a slip straight ahead, a slip angle with kappa = 0, a camber of the free wheel. The rim
// carries the load exactly; the tire has no weight.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "experiment/rigs/fe_tire/tire_rig.h"
#include "experiment/rigs/slip/rolling_stiffness.h"

namespace latsch::experiment {

/// Slopes that were asked for; others are 0.
struct RollingSlopes {
  double slip = 0.0;       // N, slip stiffness
  double cornering = 0.0;  // N/rad, cornering stiffness
  double trail = 0.0;      // m, pneumatic trail
  double camber = 0.0;     // N/rad, camber stiffness
  /// Derivatives by every parameter, slip, cornering, trail and camber, per unit; empty: not known
  /// or not asked for.
  std::vector<std::array<double, 4>> rates = {};
};

/// The slopes to measure.
struct WantedSlopes {
  bool slip = true, cornering = true, camber = true;
};

/// Measures the slopes with the friction of the tire's file, or with kAssumedFriction
/// (steady_table.h). The step of the test has no effect. `slopes`: the parameters by which
/// derivatives are asked for, or nullptr.
Result<RollingSlopes> rolling_slopes(TireRig& rig,
                                     const RollingStiffnessTest& test,
                                     const WantedSlopes& wanted,
                                     fe_tire::TireSlopes* slopes = nullptr);

}  // namespace latsch::experiment
