// SPDX-License-Identifier: Apache-2.0
// Draws chains of points around a rolling tire over their angle.
#pragma once

#include "experiment/language/test.h"

namespace latsch::experiment {

/// Draws displacements, velocities, accelerations, strains, stresses, cord forces, stored energy
/// and dissipation of every chain (rigs/fe_tire/rolling_chain_rig.h has the channels).
Test::Details chain_details(const Channels& chains);

}  // namespace latsch::experiment
