// SPDX-License-Identifier: Apache-2.0
// Characteristic slopes of the finite-element tire at free rolling, by the definitions of
// rigs/slip/rolling_stiffness.h, from pairs of steady states (rolling_rig.h) at a value and at its
// opposite: a slip straight ahead, a slip angle with kappa = 0, a camber of the free wheel. The rim
// carries the load exactly; the tire has no weight.
#pragma once

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
};

/// The slopes to measure.
struct WantedSlopes {
  bool slip = true, cornering = true, camber = true;
};

/// Measures the slopes with the friction of the tire's file, or with kAssumedFriction
/// (steady_table.h). The step of the test has no effect.
Result<RollingSlopes> rolling_slopes(TireRig& rig,
                                     const RollingStiffnessTest& test,
                                     const WantedSlopes& wanted);

}  // namespace latsch::experiment
