// SPDX-License-Identifier: Apache-2.0
// The extent of a design's points with a low target. Along a valley the target cannot tell one set
// of values from another, so points below a given level cover much of a variable's range. The
// points of a grid lie beside the floor of a valley, not on it, so the level must be at least as
// high as what one step of the grid across the valley adds to the target.
#pragma once

#include <optional>
#include <vector>

#include "correlation/study/study.h"
#include "correlation/target/best_trial.h"

namespace latsch::correlation {

struct DoeExtent {
  double level = 0.0;                  // upper limit of the target
  int points = 0;                      // points with a target of at most this level
  DesignPoint lower = {}, upper = {};  // bounding box of these points
  /// share of each variable's range that the box covers, on the variable's scale
  std::vector<double> share = {};
};

/// Considers the points among the trials that fulfill the constraints. Returns nullopt if no target
/// is at most the level.
std::optional<DoeExtent> doe_extent(const DesignSpace& space,
                                    const std::vector<RatedTrial>& points,
                                    double level);

}  // namespace latsch::correlation
