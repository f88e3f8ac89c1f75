// SPDX-License-Identifier: Apache-2.0
// Pressing the inflated tire on the ground, deflection by deflection.
#pragma once

#include <vector>

#include "base/result.h"
#include "models/fe_tire/ring/contact.h"
#include "models/fe_tire/ring/equilibrium.h"

namespace latsch::fe_tire {

/// Equilibria at the deflections given (m, from first touch), each started from a prediction out of
/// the two before it. `state` begins as the inflated ring and ends as the last equilibrium;
/// `contact` keeps the friction history. A step that does not converge is halved; the Failure names
/// the deflection where that did not help either.
Result<std::vector<LoadPoint>> load_steps(EquilibriumSolver& solver,
                                          const RingElements& elements,
                                          const Inflated& inflated,
                                          const std::vector<double>& deflections,
                                          bool friction,
                                          GroundContact& contact,
                                          RingState& state);

}  // namespace latsch::fe_tire
