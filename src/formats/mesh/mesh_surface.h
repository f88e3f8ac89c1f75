// SPDX-License-Identifier: Apache-2.0
// What a foreign mesh does not say of its outer surface: where mode shapes are compared, what may
// touch the ground.
#pragma once

#include <vector>

#include "models/fe_tire/element/mesh.h"

namespace latsch::formats {

/// Marks as tread every free outer face that looks outward more than sideways (within 45 degrees of
/// the radius): for meshes without a contact surface.
void mark_tread(fe_tire::Mesh& mesh);

/// Outer nodes at both widest places, at both edges of the tread and at the crown, from left to
/// right.
std::vector<int> choose_sensors(const fe_tire::Mesh& mesh);

}  // namespace latsch::formats
