// SPDX-License-Identifier: Apache-2.0
// Presses the tire until it carries a given vertical load.
#pragma once

#include "base/result.h"
#include "models/fe_tire/ring/fe_tire.h"

namespace latsch::experiment {

/// Equilibrium under Fz (N, > 0) within 1e-5 of it, reached in five steps of deflection. Tires
/// follow F = c d^p with p a little above 1, so the deflection is corrected by the secant of log F
/// over log d. `guess`: deflection to begin with, m.
Result<fe_tire::TireState> load_to_force(fe_tire::FeTire& tire,
                                      const fe_tire::Inflated& inflated,
                                      double Fz,
                                      double guess,
                                      const fe_tire::Ground& ground);

}  // namespace latsch::experiment
