// SPDX-License-Identifier: Apache-2.0
// Test support: writes a tire with rebars in the form of Abaqus, with its layers in embedded
// surface elements.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <sstream>
#include <string>

#include "formats/mesh/ccx_deck.h"

namespace latsch::formats {

/// Returns the cards of layer number `layer`: separate nodes, surface elements and section. In
/// every second layer the elements face inward, and the angle is counted in the opposite direction.
inline std::string rebar_cards(const fe_tire::Mesh& mesh,
                               const fe_tire::CordLayer& layer,
                               int index,
                               int& next) {
  constexpr double kXi[4] = {-1, 1, 1, -1}, kEta[4] = {-1, -1, 1, 1};
  const bool inward = index % 2 == 1;
  std::string nodes, elements;
  for (int s = 0; s < mesh.sectors; ++s)
    for (const fe_tire::Element& element : mesh.elements)
      for (const fe_tire::RebarPlacement& rebar : element.rebars) {
        if (rebar.layer != index) continue;
        const Eigen::Matrix<double, 3, 8> X = mesh.coordinates(element, s);
        std::string corners;
        for (int a = 0; a < 4; ++a) {
          const int corner = inward ? 3 - a : a;
          Eigen::Vector3d x = Eigen::Vector3d::Zero();
          for (int b = 0; b < 4; ++b)
            x += 0.25 * (1.0 + kXi[corner] * kXi[b]) * (1.0 + kEta[corner] * kEta[b]) *
                 (0.5 * (1.0 - rebar.zeta) * X.col(b) + 0.5 * (1.0 + rebar.zeta) * X.col(b + 4));
          x = 1e3 * (mesh.frame(s) * x);
          nodes += fmt::format("{},{:.12g},{:.12g},{:.12g}\n", next, x.x(), x.z(), -x.y());
          corners += fmt::format(",{}", next++);
        }
        elements += fmt::format("{}{}\n", next++, corners);
      }
  const double angle = (inward ? -1.0 : 1.0) * layer.angle * 180.0 / M_PI;
  return fmt::format(
      "*NODE\n{0}*ELEMENT,TYPE=SFM3D4,ELSET=LAYER{1}\n{2}*MATERIAL,NAME=CORD{1}\n*ELASTIC\n"
      "{3:.15g},0.3\n{6}*DENSITY\n{4:.12g}\n*SURFACE SECTION,ELSET=LAYER{1}\n"
      "*REBAR LAYER,ORIENTATION=WHEEL\nPLY{1},{5:.15g},1.0,,CORD{1},{7:.15g}\n"
      "*EMBEDDED ELEMENT,HOST ELSET=TIRE\nLAYER{1}\n",
      nodes,
      index,
      elements,
      layer.E_tension * 1e-6,
      layer.density * 1e-12,
      layer.thickness * 1e3,  // mm^2, area of a rebar at a spacing of one millimeter
      layer.E_compression == 0.0 ? "*NO COMPRESSION\n" : "",
      angle);
}

/// Returns the deck of a tire. Rebars in Abaqus have neither a separate compression modulus nor a
/// pretension, so the layers must not have them.
inline std::string rebar_deck(const fe_tire::Mesh& mesh,
                              const fe_tire::Materials& materials,
                              const CcxRun& run) {
  fe_tire::Mesh rubber = mesh;
  for (fe_tire::Element& element : rubber.elements) element.rebars.clear();
  std::ostringstream out;
  write_ccx_deck(out, rubber, materials, run);
  std::string deck = out.str(), cards;
  int next = 1'000'000;
  for (int i = 0; i < static_cast<int>(materials.layers.size()); ++i)
    cards += rebar_cards(mesh, materials.layers[static_cast<std::size_t>(i)], i, next);
  deck.insert(deck.find("*BOUNDARY"), cards);
  return deck;
}

}  // namespace latsch::formats
