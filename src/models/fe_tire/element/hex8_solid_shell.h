// SPDX-License-Identifier: Apache-2.0
// Quantities of the default element that do not depend on the displacement. The equations are in
// hex8_solid_shell_kernel.h.
#pragma once

#include "models/fe_tire/element/hex8_shape.h"

namespace latsch::fe_tire {

/// `wall`: Element::wall.
SolidShellShape make_solid_shell_shape(const Matrix38& X, double wall = 0.0);
SolidShellOperators<float> rounded(const SolidShellOperators<double>& operators);

/// Returns the factor, at least one half, by which the shear stiffness along eta is reduced in an
/// element of length h of a rubber wall of thickness t. A straight element has one curvature,
/// whereas a wall under a shear force has a curvature that varies along it; this adds the
/// flexibility h^2 / 12 D in shear [MacNeal 1978, Comput. Struct. 8].
double bending_of_shear(double h, double t);

/// Returns D of a composite wall layer with the transverse shear stiffness that one of `layer_rows`
/// elements through the layer's thickness must have.
Matrix6 layer_stiffness(const Matrix6& D, const SolidShellShape& shape, int layer_rows);

}  // namespace latsch::fe_tire
