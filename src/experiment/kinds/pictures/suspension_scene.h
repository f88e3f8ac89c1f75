// SPDX-License-Identifier: Apache-2.0
// A suspension's corner in space: links, upright, spring and wheel, at rest, in bump and rebound,
// and steered.
#pragma once

#include <vector>

#include "models/suspension/corner_geometry.h"
#include "report/scene.h"

namespace latsch::experiment {

/// Positions that the linkage does not reach are left out.
report::Scene suspension_scene(const suspension::CornerGeometry& corner);
/// Draws a car: left corners as in their files, and their mirror images.
report::Scene suspension_scene(const std::vector<suspension::CornerGeometry>& axles);

}  // namespace latsch::experiment
