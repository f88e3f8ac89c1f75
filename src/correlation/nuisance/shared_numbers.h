// SPDX-License-Identifier: Apache-2.0
// Nuisance numbers that several recordings share, such as the gain of one load cell under all of
// them: [nuisance.NAME] states the number, and each experiment names it.
//
// The shared numbers c are solved at every trial, as the own numbers z of a recording are
// (nuisance_solver.h). At given c every recording solves its z, and its weighted differences,
// extended by the priors of z, have the derivatives b = d (differences, z / sigma) / dc with z
// following c. The c of least
//   sum over the recordings of |differences|^2 + |z / sigma|^2,  plus |c / sigma|^2
// is found by Gauss-Newton steps, each halved until the sum falls: one step where the numbers are
// offsets and gains, a few with a shift. A free shift starts from the best of kFirstSharedShifts
// over the range that all its recordings allow. The slopes of the differences by the variables then
// lose their part along b, and those of z follow c.
#pragma once

#include <vector>

#include "correlation/nuisance/nuisance_solver.h"

namespace latsch::correlation {

/// One recording that shares numbers with others.
struct SharingRecording {
  const Nuisance& nuisance;
  NuisanceWeights weights;
  const Observable& observable;
  const ObjectiveSettings& settings;
  bool chooses = true;  // false: it takes the numbers as the others choose them
};

/// Compares a trial with all recordings at the best shared and own numbers. The shared numbers are
/// among the numbers of every comparison. Fails if the trial leaves a recording nothing to compare.
Result<std::vector<Comparison>> compare_together(const std::vector<SharingRecording>& recordings,
                                                 const Channels& trial);

}  // namespace latsch::correlation
