// SPDX-License-Identifier: Apache-2.0
// Materials with the storage moduli that they have at a frequency.
#pragma once

#include "models/fe_tire/history/loss_materials.h"
#include "models/fe_tire/mesh/materials.h"

namespace latsch::fe_tire {

/// Returns the relaxed materials with the storage moduli of rubbers and cord layers at the angular
/// frequency `omega`, rad/s. Solids with smeared cords stay relaxed: shapes of a tire of these
/// materials are then a less good basis, not a wrong one.
Materials stiffened(const Materials& relaxed, const LossMaterials& losses, double omega);

}  // namespace latsch::fe_tire
