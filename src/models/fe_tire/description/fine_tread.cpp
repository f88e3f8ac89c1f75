// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/description/fine_tread.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "models/fe_tire/description/contour.h"
#include "models/fe_tire/description/section_columns.h"

namespace latsch::fe_tire {
namespace {

// Half angles, rad, of the parts of the tread that are refined: that of a patch whose length is
// 0.56 of the radius, longer than at rated load, and that of the patch at the first two millimeters
// of deflection. Larger values refine more sectors.
constexpr double kReach = 0.28, kFirstReach = 0.05;

int parts(double length, double largest) {
  constexpr double kRounding = 1e-9;
  return std::max(1, static_cast<int>(std::ceil(length / largest - kRounding)));
}

/// Returns the widths of the sectors of one half of the ring, from the contact to the top, rad.
std::vector<double> sector_widths(const Section& section) {
  std::vector<double> widths;
  double left = std::numbers::pi;
  for (const SectorZone& zone : section.sector_zones) {
    widths.insert(widths.end(), zone.sectors, zone.width);
    left -= zone.sectors * zone.width;
  }
  const std::size_t half = section.sectors / 2;
  const double others = left / static_cast<double>(half - widths.size());
  widths.resize(half, others);
  return widths;
}

}  // namespace

TreadSplit split_of(const TireDescription& tire, const TreadElements& largest) {
  const Section& section = tire.section;
  TreadSplit split;
  const double half_length = 0.5 * Contour(section.contour).length();
  const std::vector<double> columns = columns_of(section);
  for (std::size_t j = 0; columns[j] < section.tread_to; ++j) {
    split.columns.push_back(parts((columns[j + 1] - columns[j]) * half_length, largest.across));
  }
  // Every column is split into at least two if any column is split, so that columns stay short
  // where the wall bends.
  if (std::ranges::max(split.columns) > 1) {
    for (int& of_column : split.columns) of_column = std::max(of_column, 2);
  }
  const double radius = section.contour.front().r + section.outside.at(0.0);
  double from = 0.0;
  for (const double width : sector_widths(section)) {
    if (from >= kReach) break;
    const double longest = from < kFirstReach ? 0.5 * largest.around : largest.around;
    split.sectors.push_back(parts(radius * width, longest));
    from += width;
  }
  return split;
}

TireDescription with_split_tread(TireDescription tire, const TreadSplit& split) {
  const auto in = [](const std::vector<int>& parts, std::size_t i) {
    return i < parts.size() ? parts[i] : 1;
  };
  const std::vector<double> whole = columns_of(tire.section);
  std::vector<double> columns;
  for (std::size_t j = 0; j + 1 < whole.size(); ++j) {
    const int p = in(split.columns, j);
    for (int k = 0; k < p; ++k) columns.push_back(whole[j] + (whole[j + 1] - whole[j]) * k / p);
  }
  columns.push_back(whole.back());
  tire = with_columns(std::move(tire), std::move(columns));

  // The zones of sectors are equal on both sides. Sectors beyond the refined ones form the last
  // zone; if the total number of sectors is odd, one of them lies at the top.
  Section& section = tire.section;
  const std::vector<double> widths = sector_widths(section);
  section.sectors = 0;
  section.sector_zones.clear();
  for (std::size_t i = 0; i < widths.size(); ++i) {
    const int p = in(split.sectors, i);
    const double width = widths[i] / p;
    if (section.sector_zones.empty() || section.sector_zones.back().width != width) {
      section.sector_zones.push_back({0, width});
    }
    section.sector_zones.back().sectors += p;
    section.sectors += 2 * p;
  }
  // The last zone needs no entry: its sectors share the rest of the ring.
  section.sector_zones.pop_back();
  return tire;
}

}  // namespace latsch::fe_tire
