// SPDX-License-Identifier: Apache-2.0
// Presses the tire until it carries a given vertical load.
#pragma once

#include "base/result.h"
#include "models/fe_tire/analysis/fe_tire.h"

namespace latsch::experiment {

/// How the wheel stands while it is pressed down.
struct StandingPose {
  double camber = 0.0;  // rad, top to the right
  /// Whether the ground will stay below the wheel center afterwards (fe_tire.h).
  fe_tire::FeTire::Poses poses = fe_tire::FeTire::Poses::below;
};

/// Pressed straight down through these deflections, m, from first touch of the upright tire.
Result<std::vector<fe_tire::TireState>> press_down(fe_tire::FeTire& tire,
                                                   const fe_tire::Inflated& inflated,
                                                   const fe_tire::Ground& ground,
                                                   const StandingPose& standing,
                                                   const std::vector<double>& deflections);

/// Equilibrium under Fz (N, > 0) within 1e-7 of it, for slopes of the deflection know nothing of
/// what is left; within 1e-5 where the force comes no nearer, as friction may have it. Tires follow
/// F = c d^p with p a little above 1, so the deflection is corrected by the secant of log F over
/// log d; every attempt goes on from the deepest state that carries less: with friction the tire is
/// pressed, never lifted. `guess`: deflection to begin with, m.
Result<fe_tire::TireState> load_to_force(fe_tire::FeTire& tire,
                                         const fe_tire::Inflated& inflated,
                                         double Fz,
                                         double guess,
                                         const fe_tire::Ground& ground,
                                         const StandingPose& pose = {});

}  // namespace latsch::experiment
