// SPDX-License-Identifier: Apache-2.0
// Material law and cord layers of an element, in the form that its kernel needs. They are computed
// once for all sectors of equal width, whenever shapes or materials change.
#pragma once

#include <vector>

#include "models/fe_tire/element/hex8.h"
#include "models/fe_tire/element/hex8_shape.h"

namespace latsch::fe_tire {

/// A cord layer in an element: the bilinear surface zeta = const with 2 x 2 integration points
/// (hex8_rebar.cpp).
struct CordSheet {
  struct Point {
    double W[3][3];  // strain by the displacements: e = (sum W_mn y_m . y_n - 1) / 2
    double p[2];     // strain by the enhanced parameters alpha_0 and alpha_1 of the solid
    double dV;       // m^3, volume of cord that the point represents
  };
  double zeta;  // surface of the layer: y = (x_1 + zeta x_13, x_2 + zeta x_23, x_12 + zeta x_123)
  CordLayer layer;
  Point points[4];
};

struct ElementLaw {
  static constexpr int kCordLayers = 12;  // largest number of cord layers

  const HexShape* shape = nullptr;
  bool linear = false;  // true: St. Venant-Kirchhoff law with the stiffness D; false: rubber
  Hyperelastic rubber;
  double D[6][6] = {};
  // Additional stiffness of the solid-shell against gradients of the thickness strain, Pa.
  double relaxation = 0.0;
  std::vector<CordSheet> cords;
  EdgeTie tie;
};

/// Computes the law of an element. The shape must outlive the result. Throws InputError if the
/// element has more than kCordLayers cord layers.
ElementLaw element_law(const HexShape& shape, const Materials& materials, const Element& element);

/// Returns the cord layers of an element for its shape.
std::vector<CordSheet> cord_sheets(const HexShape& shape,
                                   const Materials& materials,
                                   const Element& element);

}  // namespace latsch::fe_tire
