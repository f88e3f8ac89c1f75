// SPDX-License-Identifier: Apache-2.0
// Gives the elements of a foreign mesh the local axes of models/fe_tire/element/mesh.h.
//
// zeta starts at faces known to be inner (pressure) or outer (contact), goes on through opposite
// faces to the element stacked there, and from stack to stack sideways. xi is the axis nearest to
// the circumference.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "formats/mesh/hexahedron.h"

namespace latsch::formats {

/// A face of which the side is known.
struct KnownFace {
  int element = 0;
  LocalDirection outward;  // of the element
  bool inner = false;      // else outer
};

/// What became of the elements.
struct Alignment {
  std::vector<char> reached;  // from a known face; the others keep their numbering
  int buried = -1;            // one of which a known face lies against another element; -1: none
};

/// Renumbers the elements in place; X is in the tire's frame, spin axis y.
Alignment align_elements(const Eigen::Matrix3Xd& X,
                         std::vector<HexNodes>& elements,
                         const std::vector<KnownFace>& known);

}  // namespace latsch::formats
