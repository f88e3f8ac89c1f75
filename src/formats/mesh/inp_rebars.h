// SPDX-License-Identifier: Apache-2.0
// Where the layers of rebars of an .inp deck lie in the solid elements of the tire.
//
// Abaqus holds cords in surface elements without stiffness of their own, *SURFACE SECTION with
// *REBAR LAYER below it, which stand on the nodes of the solids or are an *EMBEDDED ELEMENT in
// them. A layer of models/fe_tire fills an element from side to side at one depth zeta; so every
// surface element has to span its host so, anything else is refused. Angles count from the
// circumference, which takes an ORIENTATION about the spin axis, about the normal of the surface
// element: its order of nodes says which side that is.
#pragma once

#include <functional>
#include <vector>

#include "formats/mesh/hexahedron.h"
#include "formats/deck/inp_deck.h"
#include "models/fe_tire/element/mesh.h"

namespace latsch::formats {

/// A layer of the tire: rebars of the deck (an index), turned as their surface's normal says.
struct InpLayer {
  int rebars = 0;
  int sign = 1;
  bool operator==(const InpLayer&) const = default;
};

struct InpPlacedRebars {
  std::vector<InpLayer> layers;
  std::vector<std::vector<fe_tire::RebarPlacement>> of_element;  // of the hosts
};

/// The solids of the tire, their axes those of models/fe_tire/element/mesh.h.
struct InpHosts {
  Eigen::Matrix3Xd X;              // of the nodes, any frame and unit
  std::vector<HexNodes> elements;  // indices into X
  std::map<int, int> of_number;    // place in `elements` of a number of the deck
  std::map<int, int> of_node;      // column of X of a node of the deck
};

/// `place` gives a node of the deck in the frame of X. Throws InputError naming the surface element
/// and what is wrong with it.
InpPlacedRebars place_rebars(const InpDeck& deck,
                             const InpHosts& hosts,
                             const std::function<Eigen::Vector3d(int node)>& place);

}  // namespace latsch::formats
