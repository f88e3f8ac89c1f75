// SPDX-License-Identifier: Apache-2.0
// Places the rebars of an .inp file as layers in the solid elements of the tire.
//
// Abaqus defines cords in surface elements without own stiffness, by *SURFACE SECTION followed by
// *REBAR LAYER. These share the nodes of the solids or are an *EMBEDDED ELEMENT in them. A layer of
// models/fe_tire extends through an element from side to side at one depth zeta; a surface element
// that does not extend from side to side of its host is refused. Angles are counted from the
// circumferential direction, which requires an ORIENTATION about the spin axis, and about the
// normal of the surface element, which the order of its nodes determines.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "formats/deck/inp_deck.h"
#include "formats/mesh/hexahedron.h"
#include "models/fe_tire/mesh/materials.h"
#include "models/fe_tire/mesh/mesh.h"

namespace latsch::formats {

/// A layer of the tire. It is either rebars of the deck (an index), with the sign of their
/// surface's normal, or cords that the deck models as springs (inp_cords.h).
struct InpLayer {
  int rebars = 0;  // -1: none
  int sign = 1;
  int cords = -1;  // index in InpPlacedRebars::cords; -1: no such cords
  bool operator==(const InpLayer&) const = default;
};

struct InpPlacedRebars {
  std::vector<InpLayer> layers;
  std::vector<fe_tire::CordLayer> cords;
  std::vector<std::vector<fe_tire::RebarPlacement>> of_element;  // the layers of each host
};

/// The solid elements of the tire, with the axes of models/fe_tire/mesh/mesh.h.
struct InpHosts {
  Eigen::Matrix3Xd X;              // node positions, in any frame and unit
  std::vector<HexNodes> elements;  // indices into X
  std::map<int, int> of_number;    // index in `elements` by element number of the deck
  std::map<int, int> of_node;      // column of X by node number of the deck
};

/// Returns the local coordinates of a point, by Newton's method on the trilinear map; nothing if
/// the point is far outside of the element.
std::optional<Eigen::Vector3d> local_coordinates(const Hex& X, const Eigen::Vector3d& x);

/// Places the rebars of the deck in the hosts. The function `place` returns the position of a
/// deck's node in the frame of X. Throws InputError that names the surface element and its error.
InpPlacedRebars place_rebars(const InpDeck& deck,
                             const InpHosts& hosts,
                             const std::function<Eigen::Vector3d(int node)>& place);

}  // namespace latsch::formats
