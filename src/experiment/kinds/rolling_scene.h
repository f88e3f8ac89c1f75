// SPDX-License-Identifier: Apache-2.0
// A tire that rolls, in space: its belt free and standing, and the pressure below it.
#pragma once

#include "models/tire/tire.h"
#include "report/scene.h"

namespace latsch::experiment {

/// Standing upright on flat ground at three depths, the deepest a tenth of its radius; what finds
/// no equilibrium is left out. A tire without a belt is its circle.
report::Scene rolling_scene(Tire& tire);

}  // namespace latsch::experiment
