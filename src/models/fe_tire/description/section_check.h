// SPDX-License-Identifier: Apache-2.0
// Whether a section can exist at all. Every function returns the complaint, empty where all is
// well.
#pragma once

#include <string>

#include "models/fe_tire/description/tire_description.h"

namespace latsch::fe_tire {

/// The wall crosses itself or folds over where it is thicker than it is curved.
std::string wall_conflict(const Section& section);

/// The ply leaves the wall somewhere along its extent.
std::string ply_conflict(const Section& section, const CordPly& ply);

/// Plies on which rows of elements meet are not in order, or too near to each other or to a face of
/// the wall.
std::string row_conflict(const Section& section);

/// Largest radius and width of the outer face, m.
struct OuterSize {
  double radius = 0.0, width = 0.0;
};
OuterSize outer_size(const Section& section);

}  // namespace latsch::fe_tire
