// SPDX-License-Identifier: Apache-2.0
// Checks whether a section is geometrically possible. Every function returns a message that
// describes the conflict, or an empty text if there is none.
#pragma once

#include <string>

#include "models/fe_tire/description/tire_description.h"

namespace latsch::fe_tire {

/// Returns a message if the wall crosses itself, or if it folds over because it is thicker than its
/// radius of curvature.
std::string wall_conflict(const Section& section);

/// Returns a message if the ply leaves the wall at any position.
std::string ply_conflict(const Section& section, const CordPly& ply);

/// Returns a message if plies on which rows of elements meet are not in order, or too near to each
/// other or to a face of the wall.
std::string row_conflict(const Section& section);

/// Largest radius and largest width of the outer face, m.
struct OuterSize {
  double radius = 0.0, width = 0.0;
};
OuterSize outer_size(const Section& section);

}  // namespace latsch::fe_tire
