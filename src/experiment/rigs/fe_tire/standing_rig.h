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

/// Runs the finite-element tire from equilibrium to equilibrium. Throws InputError if the tire
/// would slide away. With `slopes` returns those of all channels: upright on flat ground without
/// friction only.
Result<Channels> stand(fe_tire::FeTire& tire,
                       double own_pressure,
                       const StandingTest& test,
                       fe_tire::TireSlopes* slopes = nullptr);

}  // namespace latsch::experiment
