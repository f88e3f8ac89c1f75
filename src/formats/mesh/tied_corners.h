// SPDX-License-Identifier: Apache-2.0
// Converts corners that equations tie to a line into elements with an edge tie
// (models/fe_tire/mesh/mesh.h): a tied corner is no node of the tire's mesh.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>

#include "formats/mesh/hexahedron.h"
#include "models/fe_tire/mesh/mesh.h"

namespace latsch::formats {

/// A node on the line between two others of the same plane.
struct TiedNode {
  int lower = 0, upper = 0;
  double at = 0.0;  // 0 at the node `lower`, 1 at the node `upper`
};

/// The corners of an element, in the order of mesh.h, and the tie of one of its edges.
struct TiedElement {
  HexNodes node;  // nodes that carry the element
  fe_tire::EdgeTie tie;
};

/// Returns the element with an edge tie. `tie_of` returns the tie of a corner, or nothing if the
/// corner is a node. Returns nothing if the tied corners are not those of one side of eta, equal in
/// both planes, because the mesh of the tire has no such element.
std::optional<TiedElement> tied_element(const HexNodes& corners,
                                        const std::function<std::optional<TiedNode>(int)>& tie_of);

}  // namespace latsch::formats
