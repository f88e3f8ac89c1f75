// SPDX-License-Identifier: Apache-2.0
// Gives the elements of a foreign mesh the local axes of models/fe_tire/element/mesh.h.
//
// zeta starts at faces known to be inner (pressure) or outer (contact), continues through opposite
// faces to the elements stacked there, and from stack to stack sideways. xi is the axis nearest to
// the circumference.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "formats/mesh/hexahedron.h"

namespace latsch::formats {

/// A face whose side is known.
struct KnownFace {
  int element = 0;
  LocalDirection outward;  // outward direction of the face
  bool inner = false;      // false: outer face
};

/// Result of the alignment.
struct Alignment {
  std::vector<char> reached;  // elements reached from a known face; the others keep their numbering
  int buried = -1;            // an element with a known face against another element; -1: none
};

/// Renumbers the elements in place; X is in the tire's frame, spin axis y.
Alignment align_elements(const Eigen::Matrix3Xd& X,
                         std::vector<HexNodes>& elements,
                         const std::vector<KnownFace>& known);

}  // namespace latsch::formats
