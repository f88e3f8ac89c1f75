// SPDX-License-Identifier: Apache-2.0
// Morris' elementary effects of the target show which variables matter.
#pragma once

#include <vector>

#include "correlation/study/study.h"
#include "correlation/target/best_trial.h"
#include "optimization/design/morris.h"

namespace latsch::correlation {

/// Returns one entry for each variable, from the trials of the design's trajectories. The list is
/// empty for designs of another kind.
std::vector<ElementaryEffects> doe_effects(const Study& study,
                                           const StudyDesign& design,
                                           const std::vector<RatedTrial>& trials);

}  // namespace latsch::correlation
