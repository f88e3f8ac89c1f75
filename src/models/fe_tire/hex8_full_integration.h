// SPDX-License-Identifier: Apache-2.0
// The plain displacement element; see hex8_full_integration.cpp.
#pragma once

#include "models/fe_tire/hex8_shape.h"

namespace latsch::fe_tire {

/// Adds forces and stiffness of the solid. False where a Gauss point is inverted.
bool add_full_integration(
    const HexShape& shape, const Solid& solid, const Matrix38& u, Vector24& f, Matrix24* K);

}  // namespace latsch::fe_tire
