// SPDX-License-Identifier: Apache-2.0
// The frame in which a rig hands out forces: W, H or C of TYDEX (measurement/axes.h), ISO signs.
//
//   frame = "W"                      # in the file of a test: that of the measurement it stands for
#pragma once

#include "base/document.h"
#include "measurement/axes.h"
#include "models/tire/tire.h"

namespace latsch::experiment {

/// Of a test's file; throws InputError naming the place.
AxisFrame read_frame(const Node& test, AxisFrame fallback);
/// "W", "H", "C".
const char* name_of(AxisFrame frame);

/// What a tire does to the hub, from C. `motion`: of a wheel on ground that is level at z = 0 under
/// it; the cleat or kerb on it is no part of the frame.
Wrench in_frame(const HubForces& hub, const WheelMotion& motion, AxisFrame to);

}  // namespace latsch::experiment
