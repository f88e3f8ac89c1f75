// SPDX-License-Identifier: Apache-2.0
#include "optimization/problem/found_basin.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/units.h"

namespace latsch {

std::string in_words(const std::vector<FoundBasin>& basins, const DesignSpace& space) {
  constexpr std::size_t kMostNamed = 5;
  constexpr int kDigits = 4;
  constexpr int kMostPlaced = 6;  // variables
  std::vector<std::string> named;
  for (std::size_t k = 0; k < std::min(basins.size(), kMostNamed); ++k) {
    const FoundBasin& basin = basins[k];
    std::vector<std::string> values;
    for (int i = 0; i < space.size(); ++i)
      values.push_back(space[i].name + " " +
                       format_quantity(basin.minimum.values[static_cast<std::size_t>(i)],
                                       space[i].unit,
                                       kDigits));
    named.push_back(fmt::format("target {:.6g} ({} point{}{})",
                                basin.value,
                                basin.hits,
                                basin.hits == 1 ? "" : "s",
                                basin.has_ended ? "" : ", not followed to its end"));
    if (space.size() <= kMostPlaced) named.back() += fmt::format(" at {}", fmt::join(values, ", "));
  }
  if (basins.size() > kMostNamed)
    named.push_back(fmt::format("{} more", basins.size() - kMostNamed));
  return fmt::format("{} basin{} found{}{}",
                     basins.size(),
                     basins.size() == 1 ? "" : "s",
                     named.empty() ? "" : ": ",
                     fmt::join(named, "; "));
}

}  // namespace latsch
