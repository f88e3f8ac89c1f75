// SPDX-License-Identifier: Apache-2.0
// Cord layers inside an element.
#pragma once

#include "models/fe_tire/hex8_shape.h"
#include "models/fe_tire/nodal_sums.h"

namespace latsch::fe_tire {

/// One of the 2x2 points of a layer.
struct CordPoint {
  double W[3][3];     // strain e = (sum W_mn y_m . y_n - 1) / 2 of the displacements
  double e;           // that strain
  double p[2];        // what the solid's alpha_0 and alpha_1 add to it
  double dV;          // m^3 of cord
  double S, tangent;  // Pa, of the whole strain
};

/// A layer in an element, the bilinear surface zeta = const.
struct CordSheet {
  const CordLayer* layer;
  Lanes n[3];      // y_m = sum_a x_a n_m[a]
  double y[3][3];  // [i][m], m
  CordPoint points[4];
};

/// All layers of an element at the nodes' positions x, m.
struct Cords {
  static constexpr int kLayers = 12;  // at most

  Cords(const HexShape& shape,
        const Materials& materials,
        const Element& element,
        const Matrix38& x);

  int count = 0;
  CordSheet sheets[kLayers];
};

/// Sets the stresses at alpha_0, alpha_1 (null: none).
void stretch(Cords& cords, const double* alpha);

/// Adds forces and, where asked for, stiffness; `coupling` [alpha][direction][node], where given,
/// receives the stiffness between alpha_0, alpha_1 and the nodes.
void add_cords(const Cords& cords, bool stiffness, NodalSums& sums, Lanes (*coupling)[3]);

/// Mass [kg] of the cords between nodes; `point` is the parent coordinate of the 2x2 points.
Matrix8 rebar_mass(const Matrix38& X,
                   const Materials& materials,
                   const Element& element,
                   double point);

}  // namespace latsch::fe_tire
