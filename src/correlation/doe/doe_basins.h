// SPDX-License-Identifier: Apache-2.0
// Ranks the minima of the target over a design of experiments and judges whether the design is
// dense enough to trust them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "correlation/study/study.h"
#include "correlation/target/best_trial.h"

namespace latsch::correlation {

struct DoeBasin {
  DesignPoint lowest;
  double target = 0.0;
  int points = 0;  // points of the design that lead to this minimum
};

struct DoeBasins {
  std::string design;            // for example "full factorial grid, 5 x 5"
  int points = 0;                // points that have a target
  std::vector<DoeBasin> basins;  // lowest first
  std::string doubt;             // reason not to trust the minima; empty if they can be trusted
};

/// Returns the minima among the trials that are points of the design. Returns nullopt for Morris'
/// trajectories, which are too few to show a basin, and if less than nine of ten points of the
/// design have a target.
std::optional<DoeBasins> doe_basins(const Study& study,
                                    const StudyDesign& design,
                                    const std::vector<RatedTrial>& trials);

/// Returns the study's own design, or the finest grid of equal levels among the trials (`latsch doe
/// --levels`).
std::optional<StudyDesign> evaluated_design(const Study& study,
                                            const std::vector<RatedTrial>& trials);

}  // namespace latsch::correlation
