// SPDX-License-Identifier: Apache-2.0
// Finds out of how many equal sectors a mesh consists, and takes one of them out.
//
// Candidates are the divisors of what all rings of nodes (same radius, same place along the axis)
// have in common. A candidate S holds if turning by 2 pi / S maps every node on a node and every
// element on an element of the same kind.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "formats/mesh/hexahedron.h"

namespace latsch::formats {

/// A complete ring in the frame of models/fe_tire/element/mesh.h: spin axis y, angles from the
/// bottom toward +x.
struct Ring {
  Eigen::Matrix3Xd X;              // m
  std::vector<HexNodes> elements;  // node indices, local axes already those of mesh.h
  std::vector<std::int64_t> kind;  // of each element: what must agree between sectors
  std::vector<char> held;          // of each node
};

/// One sector of a ring.
struct Sector {
  int sectors = 1;                     // 1: no symmetry, everything as it was
  std::vector<int> nodes;              // of the ring, in the order of the sector's own numbering
  std::vector<int> elements;           // of the ring
  std::vector<HexNodes> connectivity;  // a node of the next sector counts nodes.size() higher
};

Sector find_sector(const Ring& ring);

}  // namespace latsch::formats
