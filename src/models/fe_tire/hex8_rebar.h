// SPDX-License-Identifier: Apache-2.0
// Cord layers inside an element.
#pragma once

#include "models/fe_tire/hex8_shape.h"

namespace latsch::fe_tire {

/// One of the 2x2 points of a cord layer. The cord's tangent is dX/ds = sum_a c_a X_a with |dX/ds|
/// = 1, its image l = sum_a c_a x_a, and e = (l.l - 1) / 2.
struct RebarPoint {
  Vector8 N;  // shape functions at the point
  Vector8 c;  // 1/m, derivatives of the shape functions along the cord
  double dA;  // m^2, area of the layer it stands for
};
RebarPoint rebar_point(const Matrix38& X, double zeta, double angle, int point);

/// Adds forces and stiffness of all cord layers of the element.
void add_rebars(const Matrix38& X,
                const Materials& materials,
                const Element& element,
                const Matrix38& u,
                Vector24& f,
                Matrix24* K);

}  // namespace latsch::fe_tire
