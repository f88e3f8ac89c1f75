// SPDX-License-Identifier: Apache-2.0
// Quantities of the solid-shell, the default element, that do not depend on the displacement. The
// equations are in hex8_solid_shell_kernel.h.
#pragma once

#include "models/fe_tire/element/hex8_shape.h"

namespace latsch::fe_tire {

/// Computes the operators of the solid-shell. `wall`: thickness of the wall, see Element::wall.
/// `is_arc`: X is the prism of an arc, see parent_jacobian().
SolidShellShape make_solid_shell_shape(const Matrix38& X, double wall = 0.0, bool is_arc = false);
SolidShellOperators<float> rounded(const SolidShellOperators<double>& operators);

/// Returns the factor, at least one half, by which the shear stiffness along eta is reduced for an
/// element of length h in a rubber wall of thickness t. The element represents one curvature, but
/// under a shear force the curvature of a wall varies along it. The factor adds the missing
/// flexibility h^2 / 12 D in shear [MacNeal 1978, Comput. Struct. 8].
double bending_of_shear(double h, double t);

/// Returns the stiffness D of a composite wall layer with corrected transverse shear stiffness, for
/// one of `layer_rows` elements through the layer's thickness.
Matrix6 layer_stiffness(const Matrix6& D, const SolidShellShape& shape, int layer_rows);

}  // namespace latsch::fe_tire
