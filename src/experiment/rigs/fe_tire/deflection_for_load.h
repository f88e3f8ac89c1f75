// SPDX-License-Identifier: Apache-2.0
// Presses a finite-element tire on the ground until it carries a given vertical load.
#pragma once

#include "base/result.h"
#include "models/fe_tire/analysis/fe_tire.h"

namespace latsch::experiment {

/// Position of the wheel while it is pressed down.
struct StandingPose {
  double camber = 0.0;  // rad, top to the right
  /// Says whether the ground stays below the wheel center afterwards (fe_tire.h).
  fe_tire::FeTire::Poses poses = fe_tire::FeTire::Poses::below;
};

/// Presses the tire straight down through these deflections, m, from first touch of the upright
/// tire.
Result<std::vector<fe_tire::TireState>> press_down(fe_tire::FeTire& tire,
                                                   const fe_tire::Inflated& inflated,
                                                   const fe_tire::Ground& ground,
                                                   const StandingPose& standing,
                                                   const std::vector<double>& deflections);

/// Returns the equilibrium under Fz (N, > 0), within 1e-7 of it, because slopes of the deflection
/// do not include the remaining error; within 1e-5 if the force does not converge further, as can
/// happen with friction. Tires follow F = c d^p with p a little above 1, so the deflection is
/// corrected by the secant of log F over log d. Every attempt continues from the deepest state that
/// carries less than Fz: with friction the tire is pressed, never lifted. `guess` is the first
/// deflection, m.
Result<fe_tire::TireState> load_to_force(fe_tire::FeTire& tire,
                                         const fe_tire::Inflated& inflated,
                                         double Fz,
                                         double guess,
                                         const fe_tire::Ground& ground,
                                         const StandingPose& pose = {});

}  // namespace latsch::experiment
