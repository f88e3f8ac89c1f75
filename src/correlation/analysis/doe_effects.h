// SPDX-License-Identifier: Apache-2.0
// Morris' elementary effects of the target: which variables matter.
#pragma once

#include <vector>

#include "correlation/study/study.h"
#include "correlation/target/best_trial.h"
#include "optimization/design/morris.h"

namespace latsch::correlation {

/// One entry a variable, from the trials of the design's trajectories; empty for designs of another
/// kind.
std::vector<ElementaryEffects> doe_effects(const Study& study,
                                           const StudyDesign& design,
                                           const std::vector<RatedTrial>& trials);

}  // namespace latsch::correlation
