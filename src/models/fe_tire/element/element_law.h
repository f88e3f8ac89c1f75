// SPDX-License-Identifier: Apache-2.0
// Laws and cord layers of an element in the form its kernel needs. Built once for all sectors of a
// width, whenever shapes or materials change.
#pragma once

#include <vector>

#include "models/fe_tire/element/hex8.h"
#include "models/fe_tire/element/hex8_shape.h"

namespace latsch::fe_tire {

/// A cord layer in an element: the bilinear surface zeta = const with 2x2 points (hex8_rebar.cpp).
struct CordSheet {
  struct Point {
    double W[3][3];  // strain e = (sum W_mn y_m . y_n - 1) / 2 of the displacements
    double p[2];     // addition by the solid's alpha_0 and alpha_1
    double dV;       // m^3 of cord
  };
  double zeta;  // y = (x_1 + zeta x_13, x_2 + zeta x_23, x_12 + zeta x_123)
  CordLayer layer;
  Point points[4];
};

struct ElementLaw {
  static constexpr int kCordLayers = 12;  // largest number of layers

  const HexShape* shape = nullptr;
  bool linear = false;  // true: St. Venant-Kirchhoff with D, false: rubber
  Hyperelastic rubber;
  double D[6][6] = {};
  double relaxation = 0.0;  // Pa, stiffens the solid-shell's gradients of the thickness strain
  std::vector<CordSheet> cords;
  EdgeTie tie;
};

/// The shape must outlive the law. Throws InputError if there are more than kCordLayers layers.
ElementLaw element_law(const HexShape& shape, const Materials& materials, const Element& element);

/// Returns the cord layers of an element placed in its shape.
std::vector<CordSheet> cord_sheets(const HexShape& shape,
                                   const Materials& materials,
                                   const Element& element);

}  // namespace latsch::fe_tire
