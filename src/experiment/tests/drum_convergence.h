// SPDX-License-Identifier: Apache-2.0
// Effects of step and mesh on a run on the drum: the same test with half the step, and with 3/2 of
// the segments. Fitted numbers absorb these errors unless the noise hides them, and then are wrong
// in the next test.
#pragma once

#include <string>
#include <vector>

#include "experiment/language/specimen.h"
#include "experiment/rigs/drum_rig.h"

namespace latsch::experiment {

/// Root mean square errors of a force or moment over the record, N or N m.
struct ChannelConvergence {
  std::string name, unit;
  double about_mean = 0.0;
  double by_step = 0.0;      // difference to a run with half the step
  double by_segments = 0.0;  // difference to a run with 3/2 of the segments; 0: a tire without
                             // segments
};

/// Computes the errors of Fx .. Mz in the first frame of the test; returns a Failure if one of the
/// runs has no solution.
Result<std::vector<ChannelConvergence>> drum_convergence(const SpecimenKind& kind,
                                                         const Document& numbers,
                                                         const DrumTest& test);

}  // namespace latsch::experiment
