// SPDX-License-Identifier: Apache-2.0
// The default element: what of it is the same at every displacement. Its equations are in
// hex8_solid_shell_kernel.h.
#pragma once

#include "models/fe_tire/element/hex8_shape.h"

namespace latsch::fe_tire {

SolidShellShape make_solid_shell_shape(const Matrix38& X);

/// D of a composite wall layer with its transverse shear stiffness as one of `layer_rows` elements
/// through the layer's thickness has to see it.
Matrix6 layer_stiffness(const Matrix6& D, const SolidShellShape& shape, int layer_rows);

}  // namespace latsch::fe_tire
