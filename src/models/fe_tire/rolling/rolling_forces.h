// SPDX-License-Identifier: Apache-2.0
// Forces, moments and patch of a tire that rolls, from the tractions on its tread.
#pragma once

#include <vector>

#include "models/fe_tire/grip/rolling_contact.h"
#include "models/fe_tire/rolling/rolling_case.h"
#include "models/fe_tire/rolling/tread_body.h"

namespace latsch::fe_tire {

/// Normal penalty of the ground, Pa/m, as at rest (Ground::stiffness).
inline constexpr double kNormalPenalty = 2e10;

/// Penalty along the ground, epsilon_t of (F.1), Pa/m. It is a spring in series with the tread's
/// shear. On a 205/55R16, whose G/h is 2.75e8 Pa/m, it takes some 3 % of the slip stiffness, and
/// 1e10 takes some 9 %. With 1e11 the sets of sticking points do not settle on all tires, because
/// the points outnumber the nodes (docs/notebook/rolling_tire.md).
inline constexpr double kAlongPenalty = 3e10;

/// Sums the tractions of an equilibrium of the contact in this case.
void measure(const TreadBody& body,
             const RollingContactState& contact,
             const RollingCase& of,
             RollingForces& forces,
             std::vector<RollingPatchPoint>& patch);

/// Returns the power of the drive and of the hub's motion less that of friction, W. A steady
/// elastic tire has none; what is left is an error of the discretization, because energy is
/// conserved where neighboring states of the ring are one state that is turned.
double power_balance(const RollingState& state);

}  // namespace latsch::fe_tire
