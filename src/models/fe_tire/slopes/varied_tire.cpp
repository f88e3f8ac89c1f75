// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/slopes/varied_tire.h"

#include <algorithm>
#include <variant>

namespace latsch::fe_tire {
namespace {

bool same_rebars(const Element& a, const Element& b) {
  return std::ranges::equal(a.rebars, b.rebars, [](const auto& one, const auto& other) {
    return one.layer == other.layer && one.zeta == other.zeta;
  });
}

/// Returns true if the shape, the walls and the positions of the cords of an element are the same
/// in two meshes of equal topology.
bool same_element(const Mesh& mesh, const Mesh& base, std::size_t e) {
  const Element &a = mesh.elements[e], &b = base.elements[e];
  const int n = base.nodes_per_sector();
  return mesh.theta == base.theta && same_rebars(a, b) && a.tie == b.tie && a.wall == b.wall &&
         a.layer_rows == b.layer_rows && std::ranges::all_of(b.node, [&](int node) {
           return mesh.X.col(node % n) == base.X.col(node % n);
         });
}

bool same_law(const Solid& a, const Solid& b) {
  if (a.law.index() != b.law.index()) return false;
  if (const auto* rubber = std::get_if<Hyperelastic>(&a.law)) {
    const auto& other = std::get<Hyperelastic>(b.law);
    return rubber->C10 == other.C10 && rubber->C01 == other.C01 && rubber->K == other.K;
  }
  return std::get<StVenantKirchhoff>(a.law).D == std::get<StVenantKirchhoff>(b.law).D;
}

bool same_cords(const CordLayer& a, const CordLayer& b) {
  return a.E_tension == b.E_tension && a.E_compression == b.E_compression &&
         a.thickness == b.thickness && a.angle == b.angle && a.pretension == b.pretension;
}

MovedNumber::Parts parts_that_differ(const Element& element,
                                     const Materials& varied,
                                     const Materials& base,
                                     bool same_shape) {
  MovedNumber::Parts parts{};
  const Solid &solid = varied.solids[element.solid], &other = base.solids[element.solid];
  parts.solid = !same_shape || !same_law(solid, other);
  parts.cords = same_shape ? 0u : VariedElement::kAllCords;
  parts.gas = !same_shape;
  parts.mass = !same_shape || solid.density != other.density;
  for (std::size_t k = 0; k < element.rebars.size(); ++k) {
    const int layer = element.rebars[k].layer;
    const CordLayer &cords = varied.layers[layer], &others = base.layers[layer];
    if (!same_cords(cords, others)) parts.cords |= 1u << k;
    parts.mass = parts.mass || cords.density * cords.thickness != others.density * others.thickness;
  }
  return parts;
}

}  // namespace

bool same_topology(const Mesh& a, const Mesh& b) {
  return a.sectors == b.sectors && a.X.cols() == b.X.cols() && a.clamped == b.clamped &&
         std::ranges::equal(a.elements, b.elements, [](const Element& x, const Element& y) {
           return x.node == y.node && x.solid == y.solid && x.inner == y.inner &&
                  x.tread == y.tread && x.rebars.size() == y.rebars.size();
         });
}

Varied::Varied(const VariedTire& varied, const Base& base) : tire(varied) {
  const Mesh& mesh = base.ring.mesh();
  const Materials& materials = base.elements().materials();
  same_shape = true;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const bool same = same_element(varied.mesh, mesh, e);
    parts.push_back(parts_that_differ(mesh.elements[e], varied.materials, materials, same));
    same_shape = same_shape && same;
  }
  if (!same_shape) {
    own_ring.emplace(varied.mesh, base.settings.element);
    if (base.even) own_even.emplace(varied.mesh.evenly_divided(), base.settings.element);
  }
  elements.emplace(same_shape ? base.ring : *own_ring, varied.materials);
  if (base.even) even_elements.emplace(same_shape ? *base.even : *own_even, varied.materials);
}

VariedTread::VariedTread(const Varied& varied,
                         const Systems& all,
                         Varied::Base& base,
                         bool is_halved)
    : unknowns(varied.ring(),
               is_halved ? RingSymmetry::even : RingSymmetry::none,
               is_halved ? *base.mirror() : std::vector<int>()),
      surface(unknowns, base.settings.tread_shape(), all.half_angle) {}

VariedPair::VariedPair(const Variation& variation, const Varied::Base& base)
    : below(variation.below, base), above(variation.above, base), parts(below.parts) {
  for (std::size_t e = 0; e < parts.size(); ++e) {
    parts[e].add(above.parts[e]);
    if (variation.moves_pressure) parts[e].gas = base.ring.mesh().elements[e].inner;
  }
}

}  // namespace latsch::fe_tire
