// SPDX-License-Identifier: Apache-2.0
// Draws footprints on a page: the pressure seen from above, and the elements that represent it.
#pragma once

#include <vector>

#include "experiment/language/test.h"
#include "experiment/rigs/footprint_rig.h"

namespace latsch::experiment {

/// Returns one picture for each state, with one scale of pressure for all. Numbers: "state" (from
/// 1), "x", "y", "pressure", "shear_x", "shear_y" of every element, SI.
Test::Details footprint_details(const std::vector<StandingFootprint>& states);

}  // namespace latsch::experiment
