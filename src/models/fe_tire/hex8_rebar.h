// SPDX-License-Identifier: Apache-2.0
// Cord layers inside an element.
#pragma once

#include "models/fe_tire/hex8_shape.h"
#include "models/fe_tire/nodal_sums.h"

namespace latsch::fe_tire {

/// Adds forces and, where asked for, stiffness of all cord layers of the element at the nodes'
/// positions x, m.
void add_rebars(const HexShape& shape,
                const Materials& materials,
                const Element& element,
                const Matrix38& x,
                bool stiffness,
                NodalSums& sums);

/// Mass [kg] of the cords between nodes; `point` is the parent coordinate of the 2x2 points.
Matrix8 rebar_mass(const Matrix38& X,
                   const Materials& materials,
                   const Element& element,
                   double point);

}  // namespace latsch::fe_tire
