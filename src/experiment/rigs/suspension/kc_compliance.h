// SPDX-License-Identifier: Apache-2.0
// The compliance matrix of a corner in every state of a K&C test, at the point of its loads:
// dx_by_Fx ... about_z_by_Mz, travel and rotation in the axes of the ground.
#pragma once

#include "experiment/rigs/kc_rig.h"

namespace latsch::experiment {

/// Returns 36 channels, row by row of the matrix.
Result<Channels> compliance_matrices(const suspension::CompliantCorner& corner, const KcTest& test);

}  // namespace latsch::experiment
