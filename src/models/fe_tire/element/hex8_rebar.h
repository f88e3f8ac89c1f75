// SPDX-License-Identifier: Apache-2.0
// Mass of the cord layers inside an element. Their stiffness is in element_law.h and hex8_cords.h.
#pragma once

#include "models/fe_tire/element/hex8_shape.h"

namespace latsch::fe_tire {

/// Returns the mass [kg] of the cords between nodes. `point` is the parent coordinate of the 2x2
/// points.
Matrix8 rebar_mass(const Matrix38& X,
                   const Materials& materials,
                   const Element& element,
                   double point);

}  // namespace latsch::fe_tire
