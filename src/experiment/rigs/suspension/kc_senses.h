// SPDX-License-Identifier: Apache-2.0
// Positive directions of the channels of a K&C rig by their names: "dy", "toe_R", "Fz", "pad_L",
// "about_z_L_by_Fy_R", "lateral_force_toe_in_phase". Travel, toe, camber, caster and extensions
// have the same sign in all conventions.
#pragma once

#include <string_view>

#include "models/suspension/sign_views.h"

namespace latsch::experiment {

suspension::SignSense kc_sense(std::string_view channel);

}  // namespace latsch::experiment
