// SPDX-License-Identifier: Apache-2.0
// Mass of the cord layers inside an element. Their stiffness is computed in element_law.h and
// hex8_cords.h.
#pragma once

#include <vector>

#include "models/fe_tire/element/hex8_shape.h"

namespace latsch::fe_tire {

/// A point with a part of a cord layer's mass, at the parent coordinates of one of the layer's
/// Gauss points.
struct CordMass {
  int point = 0;      // index 0 ... 3 of the Gauss point, at (kXi, kEta) times kGauss
  double zeta = 0.0;  // parent coordinate zeta of the layer
  double mass = 0.0;  // kg
};
/// Returns the four mass points of every cord layer in an element.
std::vector<CordMass> cord_masses(const HexShape& shape,
                                  const Materials& materials,
                                  const Element& element);

/// Returns the mass matrix [kg] of the cords between nodes. `point`: parent coordinate of the 2x2
/// points.
Matrix8 rebar_mass(const HexShape& shape,
                   const Materials& materials,
                   const Element& element,
                   double point);

}  // namespace latsch::fe_tire
