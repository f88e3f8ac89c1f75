// SPDX-License-Identifier: Apache-2.0
// A minimum that a search by basins has found (basin_search.h).
#pragma once

#include <string>
#include <vector>

#include "optimization/problem/design_space.h"

namespace latsch {

/// A minimum, and how many points belong to it.
struct FoundBasin {
  DesignPoint minimum;
  double value = 0.0;  // target at the minimum
  int hits = 0;
  bool has_ended = false;  // false: its search was stopped after its trials
};

/// Returns for example "2 basins found: target 0.12 (9 points) at k 21 N/mm; target 0.3 (1 point)
/// at k 44 N/mm". The first five basins are named, and their places if there are at most six
/// variables.
std::string in_words(const std::vector<FoundBasin>& basins, const DesignSpace& space);

}  // namespace latsch
