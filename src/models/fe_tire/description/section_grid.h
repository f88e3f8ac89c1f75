// SPDX-License-Identifier: Apache-2.0
// Coordinates of a section's nodes in the wall, independent of its elements. They carry
// displacements known on one mesh of a tire to another mesh as a starting point.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "models/fe_tire/description/tire_description.h"

namespace latsch::fe_tire {

/// Nodes of a section in the order of build_mesh: station by station, from inside to outside.
struct SectionGrid {
  std::vector<double> stations;           // s of the ends of columns, ascending from -1 to 1
  std::vector<std::vector<double>> rows;  // height of each station's nodes, in rows of the
                                          // unrefined crown
  int nodes() const;
};
SectionGrid section_grid(const TireDescription& tire, MeshRefinement refinement = 1);

/// Interpolates the displacements u of one plane to the nodes of another grid of the same wall: by
/// polynomials through the four surrounding stations, and linearly through the wall.
Eigen::Matrix3Xd on_grid(const SectionGrid& to, const SectionGrid& from, const Eigen::Matrix3Xd& u);

}  // namespace latsch::fe_tire
