// SPDX-License-Identifier: Apache-2.0
// Moves the ground under the tire from pose to pose and finds the equilibrium at each.
#pragma once

#include <string>

#include "base/result.h"
#include "models/fe_tire/analysis/equilibrium.h"
#include "models/fe_tire/contact/contact.h"

namespace latsch::fe_tire {

/// An equilibrium of the ring of sectors at a pose of the ground.
struct Placed {
  GroundPose pose;
  AssembledState state;
  std::vector<Anchor> anchors;
};

/// Moves from `placed` to the equilibrium at `pose`. With friction this takes several steps, each
/// of which is divided into parts that are computed on the linearized tire
/// (EquilibriumSolver::follow). Within a part a point moves along the ground in a straight line. A
/// step that does not converge is halved and repeated, and the next one may be twice as long. If
/// halving does not help, the Failure names the pose, and `placed` is unchanged.
Status move_ground(EquilibriumSolver& solver,
                   const RingElements& elements,
                   double pressure,
                   TreadContact& contact,
                   const GroundPose& pose,
                   const std::string& name,
                   Placed& placed);

}  // namespace latsch::fe_tire
