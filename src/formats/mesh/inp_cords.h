// SPDX-License-Identifier: Apache-2.0
// Finds the cords that ccx_cords.h writes as springs, and makes layers of rebars of them again.
//
// The ends of a spring are means of the corners of one element; their local coordinates give the
// depth and the angle of the layer, and the law of the spring gives its moduli and its pretension
// by cord_law.h. A deck states only
// modulus times thickness, so every layer has a thickness of one millimeter. Springs of another law
// or across elements are refused.
#pragma once

#include <functional>
#include <vector>

#include "formats/deck/inp_deck.h"
#include "formats/mesh/inp_rebars.h"
#include "models/fe_tire/element/materials.h"

namespace latsch::formats {

/// Adds the layers to `placed`. `place` returns a node of the deck in the frame of the hosts;
/// `line` the two nodes (indices) that carry a corner of a host, twice the corner if it is a node
/// itself.
void place_cords(const InpDeck& deck,
                 const InpHosts& hosts,
                 const std::function<Eigen::Vector3d(int node)>& place,
                 const std::function<std::array<int, 2>(int corner)>& line,
                 InpPlacedRebars& placed);

}  // namespace latsch::formats
