// SPDX-License-Identifier: Apache-2.0
// Forces, moments and patch of a tire that rolls, from the tractions on its tread.
#pragma once

#include <vector>

#include "models/fe_tire/motion/rolling_case.h"
#include "models/fe_tire/motion/rolling_contact.h"
#include "models/fe_tire/motion/tread_body.h"

namespace latsch::fe_tire {

/// Normal penalty of the ground, Pa/m, as at rest (Ground::stiffness).
inline constexpr double kNormalPenalty = 2e10;

/// Sums the tractions of an equilibrium of the contact in this case.
void measure(const TreadBody& body,
             const RollingContactState& contact,
             const RollingCase& of,
             RollingForces& forces,
             std::vector<RollingPatchPoint>& patch);

}  // namespace latsch::fe_tire
