// SPDX-License-Identifier: Apache-2.0
// What step and mesh change in a run on the drum: the same test with half the step, and with half
// as many segments again. Numbers that are fitted take in what of it the noise does not hide, and
// what they took in is wrong in the next test.
#pragma once

#include <string>
#include <vector>

#include "experiment/language/specimen.h"
#include "experiment/rigs/drum_rig.h"

namespace latsch::experiment {

/// Root mean squares of a force or moment over the record, N or N m.
struct ChannelConvergence {
  std::string name, unit;
  double about_mean = 0.0;
  double by_step = 0.0;      // of the difference to half the step
  double by_segments = 0.0;  // of that to 3/2 of the segments; 0: a tire without any
};

/// Of Fx .. Mz in the first of its frames; a Failure where one of the runs has no solution.
Result<std::vector<ChannelConvergence>> drum_convergence(const SpecimenKind& kind,
                                                         const Document& numbers,
                                                         const DrumTest& test);

}  // namespace latsch::experiment
