// SPDX-License-Identifier: Apache-2.0
// How far the good points of a design reach: along a valley the target cannot tell one set from
// another, and a variable has points below a level over much of its range.
//
// The points of a grid stand beside the floor of a valley, not on it, so a level has to leave room
// for that: choose it no less than what a step of the grid across the valley adds.
#pragma once

#include <optional>
#include <vector>

#include "correlation/study/study.h"
#include "correlation/target/best_trial.h"

namespace latsch::correlation {

struct DoeExtent {
  double level = 0.0;                  // of the target
  int points = 0;                      // at most there
  DesignPoint lower = {}, upper = {};  // the box around them
  std::vector<double> share = {};      // of each variable's range that the box takes, on its scale
};

/// Of the points among the trials that fulfill the constraints; nullopt where none is at most
/// there.
std::optional<DoeExtent> doe_extent(const DesignSpace& space,
                                    const std::vector<RatedTrial>& points,
                                    double level);

}  // namespace latsch::correlation
