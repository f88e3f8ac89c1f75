// SPDX-License-Identifier: Apache-2.0
// Moving the ground under the tire, pose by pose.
#pragma once

#include <string>

#include "base/result.h"
#include "models/fe_tire/analysis/equilibrium.h"
#include "models/fe_tire/contact/contact.h"

namespace latsch::fe_tire {

/// An equilibrium of the assembled sectors.
struct Placed {
  GroundPose pose;
  AssembledState state;
  std::vector<Anchor> anchors;
};

/// Moves from `placed` to the equilibrium at `pose`. With friction this takes several steps, each
/// followed in parts on the linear tire (EquilibriumSolver::follow); within a part a point moves
/// along the ground in a straight line. A step that does not converge is halved and repeated, and
/// the next one may be twice as long. If halving does not help, the Failure names the pose, and
/// `placed` is unchanged.
Status move_ground(EquilibriumSolver& solver,
                   const RingElements& elements,
                   double pressure,
                   TreadContact& contact,
                   const GroundPose& pose,
                   const std::string& name,
                   Placed& placed);

}  // namespace latsch::fe_tire
