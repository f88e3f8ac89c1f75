// SPDX-License-Identifier: Apache-2.0
// The default element: what of it is the same at every displacement. Its equations are in
// hex8_solid_shell_kernel.h.
#pragma once

#include "models/fe_tire/element/hex8_shape.h"

namespace latsch::fe_tire {

/// `wall`: Element::wall.
SolidShellShape make_solid_shell_shape(const Matrix38& X, double wall = 0.0);
SolidShellOperators<float> rounded(const SolidShellOperators<double>& operators);

/// What is left of the shear stiffness along eta in an element of length h of a rubber wall of
/// thickness t: a straight element has one curvature, a wall under a shear force one that changes
/// along it, which is as much flexibility as h^2 / 12 D in shear [MacNeal 1978, Comput. Struct. 8].
/// At least half.
double bending_of_shear(double h, double t);

/// D of a composite wall layer with its transverse shear stiffness as one of `layer_rows` elements
/// through the layer's thickness has to see it.
Matrix6 layer_stiffness(const Matrix6& D, const SolidShellShape& shape, int layer_rows);

}  // namespace latsch::fe_tire
