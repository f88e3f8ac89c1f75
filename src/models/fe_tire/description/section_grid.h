// SPDX-License-Identifier: Apache-2.0
// Coordinates of a section's nodes relative to the wall, independent of the mesh. With them
// displacements can be interpolated from one mesh of a tire to another, where they serve as
// starting point.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "models/fe_tire/description/tire_description.h"

namespace latsch::fe_tire {

/// Positions of a section's nodes, in the order of build_mesh: station by station, each from inside
/// to outside.
struct SectionGrid {
  std::vector<double> stations;  // positions s at which columns end, ascending from -1 to 1
  // For each station, heights of its nodes, in rows of the unrefined crown.
  std::vector<std::vector<double>> rows;
  int nodes() const;
};
SectionGrid section_grid(const TireDescription& tire, MeshRefinement refinement = 1);

/// Interpolates the displacements u of one section plane to the nodes of another grid of the same
/// wall. Interpolation is by polynomials through the four nearest stations along the wall, and
/// linear through the wall.
Eigen::Matrix3Xd on_grid(const SectionGrid& to, const SectionGrid& from, const Eigen::Matrix3Xd& u);

}  // namespace latsch::fe_tire
