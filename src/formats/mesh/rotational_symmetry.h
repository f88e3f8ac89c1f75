// SPDX-License-Identifier: Apache-2.0
// Finds the number of equal sectors of a mesh and extracts one of them.
//
// Candidates are the common divisors of the node counts of all rings (equal radius, equal position
// along the axis). A candidate S is valid if rotation by 2 pi / S maps every node to a node and
// every element to an element of the same kind. If there is no such rotation, sectors of unequal
// width are sought: planes with the same nodes in their own frames, the first at the bottom, the
// others symmetric to it, with the same elements between any two neighbors.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "formats/mesh/hexahedron.h"

namespace latsch::formats {

/// A complete ring in the frame of models/fe_tire/mesh/mesh.h: spin axis y, angles from the
/// bottom toward +x.
struct RingOfNodes {
  Eigen::Matrix3Xd X;              // m
  std::vector<HexNodes> elements;  // node indices; local axes are already those of mesh.h
  std::vector<std::int64_t> kind;  // one for each element; equal in all sectors
  std::vector<char> held;          // for each node, whether it is fixed
};

/// One sector of a ring.
struct Sector {
  int sectors = 1;            // 1: no symmetry, everything unchanged
  std::vector<double> theta;  // angles of the planes, rad; empty: sectors are equal
  /// For each node of the sector, in the sector's own numbering, the node of the ring.
  std::vector<int> nodes;
  std::vector<int> elements;  // elements of the ring
  /// nodes of the elements; for a node of the next sector nodes.size() is added
  std::vector<HexNodes> connectivity;
};

Sector find_sector(const RingOfNodes& ring);

}  // namespace latsch::formats
