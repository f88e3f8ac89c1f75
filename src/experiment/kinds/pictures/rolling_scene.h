// SPDX-License-Identifier: Apache-2.0
// Draws a rolling tire in space: its unloaded belt, its belt on the ground, and the contact
// pressure below it.
#pragma once

#include "models/tire/tire.h"
#include "report/scene.h"

namespace latsch::experiment {

/// Shows the tire upright on flat ground at three depths, the deepest a tenth of its radius; depths
/// without equilibrium are left out. A tire without a belt is drawn as a circle.
report::Scene rolling_scene(Tire& tire);

}  // namespace latsch::experiment
