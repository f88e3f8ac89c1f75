// SPDX-License-Identifier: Apache-2.0
// Checks that a section can exist at all. Every function returns the complaint, or an empty text if
// there is none.
#pragma once

#include <string>

#include "models/fe_tire/description/tire_description.h"

namespace latsch::fe_tire {

/// The wall must not cross itself or fold over where it is thicker than its radius of curvature.
std::string wall_conflict(const Section& section);

/// The ply must stay inside the wall along its whole extent.
std::string ply_conflict(const Section& section, const CordPly& ply);

/// Plies on which rows of elements meet must be in order and not too near to each other or to a
/// face of the wall.
std::string row_conflict(const Section& section);

/// Largest radius and width of the outer face, m.
struct OuterSize {
  double radius = 0.0, width = 0.0;
};
OuterSize outer_size(const Section& section);

}  // namespace latsch::fe_tire
