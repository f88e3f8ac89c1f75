// SPDX-License-Identifier: Apache-2.0
// Effects of time step and mesh on a run on the drum: the same test with half the step, and with
// 3/2 of the segments. A fit compensates these errors by wrong parameters unless they are smaller
// than the noise, and its predictions of other tests are then wrong.
#pragma once

#include <string>
#include <vector>

#include "experiment/language/specimen.h"
#include "experiment/language/test.h"
#include "experiment/rigs/drum_rig.h"

namespace latsch::experiment {

/// Computes the errors of Fx .. Mz in the first frame of the test; returns a Failure if one of the
/// runs has no solution.
Result<std::vector<ChannelConvergence>> drum_convergence(const SpecimenKind& kind,
                                                         const Document& numbers,
                                                         const DrumTest& test);

}  // namespace latsch::experiment
