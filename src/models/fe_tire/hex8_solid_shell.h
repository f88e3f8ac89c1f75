// SPDX-License-Identifier: Apache-2.0
// The default element; see hex8_solid_shell.cpp.
#pragma once

#include "models/fe_tire/hex8_rebar.h"
#include "models/fe_tire/hex8_shape.h"
#include "models/fe_tire/nodal_sums.h"
#include "models/fe_tire/point_law.h"

namespace latsch::fe_tire {

SolidShellShape make_solid_shell_shape(const Matrix38& X);

/// D of a composite wall layer with its transverse shear stiffness as one of `layer_rows` elements
/// through the layer's thickness has to see it.
Matrix6 layer_stiffness(const Matrix6& D, const SolidShellShape& shape, int layer_rows);

/// Adds forces and, where asked for, stiffness of solid and cords at the nodes' positions x, m.
/// alpha is solved from the values given. `relaxation` in Pa stiffens the enhanced in-plane
/// gradients of the thickness strain. False where the element is inverted or alpha cannot be
/// solved.
bool add_solid_shell(const HexShape& shape,
                     const PointLaw& law,
                     double relaxation,
                     const Matrix38& x,
                     Cords& cords,
                     double* alpha,
                     bool stiffness,
                     NodalSums& sums);

}  // namespace latsch::fe_tire
