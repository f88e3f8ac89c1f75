// SPDX-License-Identifier: Apache-2.0
#include "correlation/doe/doe_extent.h"

#include <algorithm>

namespace latsch::correlation {

std::optional<DoeExtent> doe_extent(const DesignSpace& space,
                                    const std::vector<RatedTrial>& points,
                                    double level) {
  DoeExtent found{.level = level};
  for (const RatedTrial& at : points) {
    if (at.violation > 0.0 || !(at.target <= level)) continue;
    if (found.points++ == 0) found.lower = found.upper = at.point;
    for (int i = 0; i < space.size(); ++i) {
      found.lower.values[i] = std::min(found.lower.values[i], at.point.values[i]);
      found.upper.values[i] = std::max(found.upper.values[i], at.point.values[i]);
    }
  }
  if (found.points == 0) return std::nullopt;
  const auto from = space.to_unit(found.lower), to = space.to_unit(found.upper);
  for (int i = 0; i < space.size(); ++i) found.share.push_back(to[i] - from[i]);
  return found;
}

}  // namespace latsch::correlation
