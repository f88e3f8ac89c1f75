// SPDX-License-Identifier: Apache-2.0
// Where the nodes of a section are in the wall, whatever its elements: so that what is known of a
// tire on one mesh is a start on another one.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "models/fe_tire/description/tire_description.h"

namespace latsch::fe_tire {

/// Nodes of a section in the order of build_mesh: station by station, from inside to outside.
struct SectionGrid {
  std::vector<double> stations;           // s of the ends of columns, ascending from -1 to 1
  std::vector<std::vector<double>> rows;  // at each of them, in rows of the unrefined crown
  int nodes() const;
};
SectionGrid section_grid(const TireDescription& tire, Refinement refinement = 1);

/// Displacements u of one plane on the nodes of another grid of the same wall, by polynomials
/// through the four stations around, linearly through the wall.
Eigen::Matrix3Xd on_grid(const SectionGrid& to, const SectionGrid& from, const Eigen::Matrix3Xd& u);

}  // namespace latsch::fe_tire
