// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/description/section_plan.h"

#include <fmt/format.h>

#include <cmath>

namespace latsch::fe_tire {

SectionPlan::SectionPlan(const TireDescription& tire) : tire_(tire), plies_(columns()) {
  const Section& section = tire.section;
  for (int column = 0; column < columns(); ++column)
    middles_.push_back(0.5 * (section.station(column) + section.station(column + 1)));
  for (int column = 0; column < columns(); ++column)
    for (int ply = 0; ply < static_cast<int>(tire.plies.size()); ++ply)
      if (tire.plies[ply].extent.contains(std::abs(middle(column))))
        plies_[column].push_back({ply, layers_++});
}

int SectionPlan::region(int column, int row) const {
  const double q = std::abs(middle(column));
  int found = -1;
  for (int i = 0; i < static_cast<int>(tire_.regions.size()); ++i) {
    const RubberRegion& region = tire_.regions[i];
    const bool side =
        region.side == LineSide::both || (region.side == LineSide::inside) == inside(row);
    if (!side || !region.extent.contains(q)) continue;
    if (found >= 0)
      throw InputError(tire_.place,
                       fmt::format("regions \"{}\" and \"{}\" overlap at position {:.3f}, {}",
                                   tire_.regions[found].name,
                                   region.name,
                                   q,
                                   inside(row) ? "inside" : "outside"));
    found = i;
  }
  if (found < 0)
    throw InputError(
        tire_.place,
        fmt::format(
            "no rubber region covers position {:.3f}, {}", q, inside(row) ? "inside" : "outside"));
  return found;
}

int SectionPlan::solid(int column, int row, int refined_column) const {
  if (smeared(row)) return static_cast<int>(tire_.regions.size()) + refined_column;
  return region(column, row);
}

}  // namespace latsch::fe_tire
