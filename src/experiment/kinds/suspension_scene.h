// SPDX-License-Identifier: Apache-2.0
// A suspension's corner in space: links, upright, spring and wheel, at rest, in bump and rebound,
// steered.
#pragma once

#include <vector>

#include "models/suspension/corner_geometry.h"
#include "report/scene.h"

namespace latsch::experiment {

/// Positions its linkage does not reach are left out.
report::Scene suspension_scene(const suspension::CornerGeometry& corner);
/// Of a car: left corners as their files have them, and their mirror images.
report::Scene suspension_scene(const std::vector<suspension::CornerGeometry>& axles);

}  // namespace latsch::experiment
