// SPDX-License-Identifier: Apache-2.0
#include "formats/mesh/inp_ground.h"

#include <vector>

#include "formats/mesh/hexahedron.h"

namespace latsch::formats {

InpGroundBodies ground_bodies(const InpDeck& deck, const std::map<int, int>& held) {
  std::map<int, std::vector<int>> elements_at;
  for (const auto& [number, element] : deck.elements)
    for (int node : element.node) elements_at[node].push_back(number);
  std::set<int> masters, seen;
  for (const InpContact& contact : deck.contacts)
    for (const InpFaces& faces : deck.surfaces.at(contact.master))
      masters.insert(faces.elements.begin(), faces.elements.end());
  InpGroundBodies ground;
  for (const auto& [first, unused] : deck.elements) {
    std::vector<int> open{first}, body;
    bool is_master = false, is_held = true;
    while (!open.empty()) {
      const int number = open.back();
      open.pop_back();
      if (!seen.insert(number).second) continue;
      body.push_back(number);
      is_master = is_master || masters.count(number);
      for (int node : deck.elements.at(number).node) {
        const auto directions = held.find(node);
        is_held = is_held && directions != held.end() && directions->second == kHeldInAllDirections;
        const std::vector<int>& neighbors = elements_at[node];
        open.insert(open.end(), neighbors.begin(), neighbors.end());
      }
    }
    if (!is_master && !is_held) continue;
    for (int number : body) {
      ground.elements.insert(number);
      const auto& nodes = deck.elements.at(number).node;
      ground.nodes.insert(nodes.begin(), nodes.end());
    }
  }
  return ground;
}

std::set<int> ground_face_nodes(const InpDeck& deck) {
  std::set<int> nodes;
  for (const InpContact& contact : deck.contacts)
    for (const InpFaces& faces : deck.surfaces.at(contact.master))
      for (int number : faces.elements)
        for (int corner : face_corners(face_direction(faces.face)))
          nodes.insert(deck.elements.at(number).node[corner]);
  return nodes;
}

std::optional<Eigen::Vector3d> middle_of_ground(const InpDeck& deck) {
  const std::set<int> nodes = ground_face_nodes(deck);
  if (nodes.empty()) return std::nullopt;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int node : nodes) sum += deck.nodes.at(node);
  return Eigen::Vector3d(sum / static_cast<double>(nodes.size()));
}

}  // namespace latsch::formats
