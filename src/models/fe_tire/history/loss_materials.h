// SPDX-License-Identifier: Apache-2.0
// Prony terms (prony.h) of a tire's solids and cord layers, in the numbering of its materials.
//
// Rubber relaxes on its isochoric stress (H.1). A solid with smeared cords is the sum of its
// rubber, whose shear stress relaxes, and of cords in several directions, each of which relaxes on
// the whole stress that it adds. Cord layers relax on their stress S(e) along the cords.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "models/fe_tire/history/prony.h"
#include "models/fe_tire/mesh/materials.h"

namespace latsch::fe_tire {

/// A stress D E that relaxes.
struct RelaxingCords {
  Matrix6 D;  // Pa, in the cylindrical axes of a point
  PronyTerms terms;
  int owner;  // index into LossMaterials::owners
};

struct RelaxingSolid {
  PronyTerms terms;    // on the isochoric stress of the rubber
  int owner = 0;       // index into LossMaterials::owners
  double shear = 0.0;  // Pa, shear modulus of the rubber in a solid with smeared cords
  std::vector<RelaxingCords> smeared = {};  // empty: the solid is rubber alone
};

struct RelaxingLayer {
  PronyTerms terms;
  int owner = 0;  // index into LossMaterials::owners
};

struct LossMaterials {
  /// A rubber or a ply of the tire's file, to which power is counted.
  struct Owner {
    std::string name;  // "rubber.tread", "layer.belt_1"
    bool is_cord = false;
  };
  std::vector<Owner> owners;
  std::vector<RelaxingSolid> solids;  // numbered like Materials::solids
  std::vector<RelaxingLayer> layers;  // numbered like Materials::layers

  /// True if nothing relaxes: the tire is elastic.
  bool is_elastic() const {
    const auto relaxes = [](const auto& one) { return !one.terms.empty(); };
    return std::ranges::none_of(layers, relaxes) &&
           std::ranges::none_of(solids, [&](const RelaxingSolid& solid) {
             return relaxes(solid) || std::ranges::any_of(solid.smeared, relaxes);
           });
  }
};

}  // namespace latsch::fe_tire
