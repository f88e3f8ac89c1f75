// SPDX-License-Identifier: Apache-2.0
// Values of the target over two variables, taken from a full factorial design in the journal.
#pragma once

#include <vector>

#include "correlation/study/study.h"
#include "correlation/target/best_trial.h"
#include "report/report.h"

namespace latsch::correlation {

/// Returns one surface for every pair of variables, through the best point of the largest complete
/// grid among the trials; the other variables are held at that point. The list is empty if there is
/// no grid. The point `found` is marked.
std::vector<report::Surface> doe_surfaces(const Study& study,
                                          const std::vector<RatedTrial>& trials,
                                          const DesignPoint& found);

}  // namespace latsch::correlation
