// SPDX-License-Identifier: Apache-2.0
// Moving the ground under the tire, pose by pose.
#pragma once

#include <string>

#include "base/result.h"
#include "models/fe_tire/analysis/equilibrium.h"
#include "models/fe_tire/contact/contact.h"

namespace latsch::fe_tire {

/// An equilibrium of what is assembled.
struct Placed {
  GroundPose pose;
  RingState state;
  std::vector<Anchor> anchors;
};

/// Goes on from `placed` to the equilibrium at `pose`. With friction in steps, each followed in
/// parts on the linear tire (EquilibriumSolver::follow): a point's way along the ground is straight
/// in a part. A step that does not converge is halved and begins anew, the next one may be twice as
/// long; the Failure names the pose where that did not help either, and `placed` then is as it was.
std::optional<Failure> move_ground(EquilibriumSolver& solver,
                                   const RingElements& elements,
                                   double pressure,
                                   TreadContact& contact,
                                   const GroundPose& pose,
                                   const std::string& name,
                                   Placed& placed);

}  // namespace latsch::fe_tire
