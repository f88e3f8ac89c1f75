// SPDX-License-Identifier: Apache-2.0
// What a page shows of footprints: the pressure from above, and the elements it is drawn from.
#pragma once

#include <vector>

#include "experiment/language/test.h"
#include "experiment/rigs/footprint_rig.h"

namespace latsch::experiment {

/// A picture a state, one scale of pressure for all. Numbers: "state" (from 1), "x", "y",
/// "pressure", "shear_x", "shear_y" of every element, SI.
Test::Details footprint_details(const std::vector<StandingFootprint>& states);

}  // namespace latsch::experiment
