// SPDX-License-Identifier: Apache-2.0
// From corners that equations hold on a line to elements with an edge tie (models/fe_tire/element/
// mesh.h): a tied corner is no node of the tire's mesh.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>

#include "formats/mesh/hexahedron.h"
#include "models/fe_tire/element/mesh.h"

namespace latsch::formats {

/// A node that lies on the line between two others of the same plane.
struct TiedNode {
  int lower = 0, upper = 0;
  double at = 0.0;  // 0 at the lower, 1 at the upper node
};

/// Corners of an element, in the order of mesh.h, and what of them is tied.
struct TiedElement {
  HexNodes node;  // the nodes that carry it
  fe_tire::EdgeTie tie;
};

/// `tie_of` gives the tie of a corner, or nothing for a node. Returns nothing where the tied
/// corners are not those of one side of eta, alike in both planes: no element of this mesh.
std::optional<TiedElement> tied_element(const HexNodes& corners,
                                        const std::function<std::optional<TiedNode>(int)>& tie_of);

}  // namespace latsch::formats
