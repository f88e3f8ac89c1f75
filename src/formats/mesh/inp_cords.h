// SPDX-License-Identifier: Apache-2.0
// Recognizes the springs by which ccx_cords.h writes cords, and converts them to layers of rebars
// again.
//
// The ends of a spring are means of the corners of one element; their local coordinates give the
// depth and the angle of the layer, and the law of the spring (cord_law.h) gives its moduli and its
// pretension. A deck states only the product of modulus and thickness, so every layer gets a
// thickness of one millimeter. Springs with another law, or between two elements, are refused.
#pragma once

#include <functional>
#include <vector>

#include "formats/deck/inp_deck.h"
#include "formats/mesh/inp_rebars.h"
#include "models/fe_tire/mesh/materials.h"

namespace latsch::formats {

/// Adds the layers of cords to `placed`. The function `place` returns the position of a node of the
/// deck in the frame of the host elements. The function `line` returns the indices of the two nodes
/// that determine a corner of a host element; both are the corner itself if it is a node.
void place_cords(const InpDeck& deck,
                 const InpHosts& hosts,
                 const std::function<Eigen::Vector3d(int node)>& place,
                 const std::function<std::array<int, 2>(int corner)>& line,
                 InpPlacedRebars& placed);

}  // namespace latsch::formats
