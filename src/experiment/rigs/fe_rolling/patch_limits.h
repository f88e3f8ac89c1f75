// SPDX-License-Identifier: Apache-2.0
// Patches of a rolling finite-element tire that its mesh or its ground cannot represent.
#pragma once

#include <string>

#include "base/result.h"
#include "experiment/rigs/fe_tire/rolling_rig.h"

namespace latsch::experiment {

/// Returns in words that the sectors at the ground are too long for the patch of a state: forces of
/// few points along the patch depend on the mesh. The patch is at least Fz/p over the tire's width
/// long. Empty if every patch is long enough.
std::string words_on_sectors(const TireRig& rig, const RollingTest& test);

/// Fails if the patch of a state reaches farther around a drum of this radius, m, than half a
/// radian to one side: the tread would have to follow the drum around its flanks.
Status check_drum(const fe_tire::RollingState& state, double drum_radius);

}  // namespace latsch::experiment
