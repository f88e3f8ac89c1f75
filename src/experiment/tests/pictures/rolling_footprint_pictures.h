// SPDX-License-Identifier: Apache-2.0
// Draws the footprints of a tire that rolls: pressure, shear, grip and sliding speed from above.
#pragma once

#include <vector>

#include "experiment/language/test.h"
#include "experiment/rigs/fe_tire/rolling_footprint.h"

namespace latsch::experiment {

/// Returns four pictures for each state, each quantity with one scale for all states. Numbers:
/// "state" (from 1), "line" (from 0 at the right edge), "x", "y", "pressure", "shear_x", "shear_y",
/// "slide_x", "slide_y", "grip", "power" (W/m^2, lost by sliding) of every point in contact, SI,
/// along each line from front to back.
Test::Details rolling_footprint_details(const std::vector<RolledState>& states);

}  // namespace latsch::experiment
