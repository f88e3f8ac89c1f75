// SPDX-License-Identifier: Apache-2.0
// The plain displacement element; see hex8_full_integration.cpp.
#pragma once

#include "models/fe_tire/hex8_shape.h"
#include "models/fe_tire/nodal_sums.h"
#include "models/fe_tire/point_law.h"

namespace latsch::fe_tire {

/// Adds forces and, where asked for, stiffness of the solid at the nodes' positions x, m. False
/// where a Gauss point is inverted.
bool add_full_integration(
    const HexShape& shape, const PointLaw& law, const Matrix38& x, bool stiffness, NodalSums& sums);

}  // namespace latsch::fe_tire
