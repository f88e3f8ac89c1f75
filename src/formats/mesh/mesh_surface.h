// SPDX-License-Identifier: Apache-2.0
// Determines two properties that a foreign mesh does not state: the points at which mode shapes are
// compared, and the outer surface that may touch the ground.
#pragma once

#include <vector>

#include "models/fe_tire/mesh/mesh.h"

namespace latsch::formats {

/// Marks as tread every free outer face that faces outward more than sideways (within 45 degrees of
/// the radius). Used for meshes without a contact surface.
void mark_tread(fe_tire::Mesh& mesh);

/// Returns five outer nodes as sensors, from left to right: at both widest positions, at both edges
/// of the tread and at the crown.
std::vector<int> choose_sensors(const fe_tire::Mesh& mesh);

}  // namespace latsch::formats
