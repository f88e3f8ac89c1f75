// SPDX-License-Identifier: Apache-2.0
// Gives the elements of a foreign mesh the local axes of models/fe_tire/mesh/mesh.h. The axis
// zeta is first determined at faces known to be inner (pressure) or outer (contact). From there it
// continues through opposite faces to the elements stacked on them, and from stack to stack
// sideways. xi is the axis nearest to the circumferential direction.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "formats/mesh/hexahedron.h"

namespace latsch::formats {

/// A face that is known to be an inner or an outer face of the tire.
struct KnownFace {
  int element = 0;
  LocalDirection outward;  // outward normal of the face
  bool inner = false;      // false: outer face
};

/// Result of align_elements().
struct Alignment {
  /// true for elements connected with a known face; the others keep their numbering
  std::vector<char> reached;
  /// an element whose known face lies against another element, which is an error; -1: none
  int buried = -1;
};

/// Renumbers the nodes of the elements in place. X has the node positions in the tire's frame, with
/// spin axis y.
Alignment align_elements(const Eigen::Matrix3Xd& X,
                         std::vector<HexNodes>& elements,
                         const std::vector<KnownFace>& known);

}  // namespace latsch::formats
