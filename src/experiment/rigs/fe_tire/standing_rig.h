// SPDX-License-Identifier: Apache-2.0
// Runs the test of static_stiffness.h on a finite-element tire that does not roll, as a sequence of
// equilibria.
#pragma once

#include "experiment/rigs/static_stiffness.h"

namespace latsch::fe_tire {
class FeTire;
class TireSlopes;
}  // namespace latsch::fe_tire

namespace latsch::experiment {

/// Runs the finite-element tire from one equilibrium to the next. Throws InputError if the tire
/// would slide away. If `slopes` is given, returns in it the derivatives of all channels, which are
/// known only for an upright tire on flat ground without friction.
Result<Channels> stand(fe_tire::FeTire& tire,
                       double own_pressure,
                       const StandingTest& test,
                       fe_tire::TireSlopes* slopes = nullptr);

}  // namespace latsch::experiment
