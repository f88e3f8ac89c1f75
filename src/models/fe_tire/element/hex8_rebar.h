// SPDX-License-Identifier: Apache-2.0
// Mass of the cord layers inside an element. Their stiffness is in element_law.h and hex8_cords.h.
#pragma once

#include <vector>

#include "models/fe_tire/element/hex8_shape.h"

namespace latsch::fe_tire {

/// A point that stands for a part of a cord layer's mass. The parent coordinates of the point are
/// those of its Gauss point.
struct CordMass {
  int point = 0;      // Gauss point 0 ... 3, at kXi, kEta times kGauss
  double zeta = 0.0;  // parent coordinate of the layer
  double mass = 0.0;  // kg
};
/// Returns four points for each layer of cords.
std::vector<CordMass> cord_masses(const Matrix38& X,
                                  const Materials& materials,
                                  const Element& element);

/// Returns the mass [kg] of the cords between nodes. `point` is the parent coordinate of the 2x2
/// points.
Matrix8 rebar_mass(const Matrix38& X,
                   const Materials& materials,
                   const Element& element,
                   double point);

}  // namespace latsch::fe_tire
