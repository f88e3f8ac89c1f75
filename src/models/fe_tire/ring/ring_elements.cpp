// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/ring/ring_elements.h"

namespace latsch::fe_tire {

RingElements::RingElements(const Ring& ring, Materials materials)
    : ring_(ring),
      materials_(std::move(materials)),
      laws_(ring.widths()),
      surroundings_(ring.widths()) {
  const Mesh& mesh = ring.mesh();
  for (int s = 0; s < ring.sectors(); ++s) {
    const int width = ring.width(s);
    if (!laws_[width].empty()) continue;
    const Eigen::Matrix3d& Q = ring.rotation(s);
    for (int e = 0; e < ring.elements_per_sector(); ++e) {
      const Element& element = mesh.elements[e];
      laws_[width].push_back(element_law(ring.shape(s, e), materials_, element));
      ElementSurroundings& around = surroundings_[width].emplace_back();
      around.cosine = Q(0, 0);
      around.sine = Q(0, 2);
      for (int a = 0; a < 8; ++a) {
        if (element.node[a] >= mesh.nodes_per_sector()) around.turned |= 1u << a;
      }
      for (int k = 0; k < 4; ++k) {
        if (ring.is_edge_open(e, k)) around.open_edges |= 1u << k;
      }
    }
  }
}

RingElements::RingElements(
    const RingElements& of,
    const std::function<void(const Element& element, ElementLaw& law)>& change)
    : ring_(of.ring_), materials_(of.materials_), laws_(of.laws_), surroundings_(of.surroundings_) {
  for (std::vector<ElementLaw>& laws : laws_)
    for (std::size_t e = 0; e < laws.size(); ++e) change(ring_.mesh().elements[e], laws[e]);
}

void RingElements::add_dead_stresses() {
  dead_.assign(ring_.sectors(), {});
  for (const Sectors& group : groups(ring_.sectors()))
    dead_[group.first].resize(ring_.elements_per_sector());
}

std::vector<RingElements::Sectors> RingElements::groups(int count) const {
  std::vector<Sectors> groups;
  for (int s = 0; s < count; ++s) {
    if (groups.empty() || groups.back().count == ElementBatch::kLanes ||
        ring_.width(s) != ring_.width(groups.back().first)) {
      groups.push_back({s, 0});
    }
    ++groups.back().count;
  }
  return groups;
}

unsigned RingElements::evaluate(
    int sector, int element, double pressure, Stiffness stiffness, ElementBatch& batch) const {
  const int width = ring_.width(sector);
  ElementSurroundings around = surroundings_[width][element];
  if (ring_.mesh().elements[element].inner) around.pressure = pressure;
  if (!dead_.empty()) batch.dead = &dead_[sector][element];
  return fe_tire::evaluate(laws_[width][element], around, stiffness, batch);
}

}  // namespace latsch::fe_tire
