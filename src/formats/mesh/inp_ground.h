// SPDX-License-Identifier: Apache-2.0
// Finds in an .inp deck of a tire the ground on which the tire stands: elements and nodes that are
// no part of the tire, and the faces that the tire touches. Positions are in the frame and units of
// the file.
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <set>

#include "formats/deck/inp_deck.h"

namespace latsch::formats {

constexpr int kHeldInAllDirections = 7;  // one bit for each direction

/// Numbers of the elements and nodes of the ground.
struct InpGroundBodies {
  std::set<int> elements, nodes;
};

/// Returns every body with a master surface of the contact, and every body whose nodes are all
/// fixed. `held` has the fixed directions of nodes, as bits. Surfaces and nodes must exist
/// (inp_references.h).
InpGroundBodies ground_bodies(const InpDeck& deck, const std::map<int, int>& held);

/// Returns the numbers of the nodes on the contact's master faces.
std::set<int> ground_face_nodes(const InpDeck& deck);

/// Returns the mean of these nodes; none without contact.
std::optional<Eigen::Vector3d> middle_of_ground(const InpDeck& deck);

}  // namespace latsch::formats
