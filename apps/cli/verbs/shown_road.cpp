// SPDX-License-Identifier: Apache-2.0
// Implements `latsch show` for a road: heights along lines of equal y, or of equal v for a curved
// grid.
#include <fmt/format.h>

#include <cmath>

#include "base/text.h"
#include "cli/verbs/shown_file.h"
#include "formats/road/road_file.h"

namespace latsch::cli {
namespace {

constexpr int kPoints = 2000;  // number of points on a line
constexpr int kLines = 5;
constexpr double kWide = 1040.0, kHigh = 340.0;  // pixels

/// Part of the road that is shown, m, along it and to both sides. For a road without bounds it lies
/// around the origin.
struct Extent {
  double from = -5.0, to = 5.0, right = -0.5, left = 0.5;
};

Extent extent_of(const formats::RoadFile& file) {
  if (file.crg) {
    const auto& grid = file.crg->grid();
    return {grid.u_begin, grid.u_end(), grid.v.front(), grid.v.back()};
  }
  if (file.triangles) {
    const auto low = file.triangles->low(), high = file.triangles->high();
    return {low.x(), high.x(), low.y(), high.y()};
  }
  return {};
}

void add_heights(const formats::RoadFile& file, ShownFile& shown) {
  const Extent extent = extent_of(file);
  ShownTable table{"Heights", {"line", "smallest [m]", "mean [m]", "largest [m]"}, {}};
  report::LinePlot plot{"Heights along the road", file.crg ? "u [m]" : "x [m]", "z [m]", {}};
  plot.width = kWide;
  plot.height = kHigh;
  for (int k = 0; k < kLines; ++k) {
    const double aside = (extent.right * (kLines - 1 - k) + extent.left * k) / (kLines - 1);
    report::PlotLine line{
        fmt::format("{} = {} m", file.crg ? "v" : "y", format_number(aside, 4)), {}, {}, k, {}};
    for (int i = 0; i <= kPoints; ++i) {
      const double along = extent.from + (extent.to - extent.from) * i / kPoints;
      line.x.push_back(along);
      line.y.push_back(file.crg ? file.crg->elevation({along, aside}).value_or(std::nan(""))
                                : file.road->height(along, aside, 0.0));
    }
    const auto row = statistics({"", "m", line.y});
    table.rows.push_back({line.name, row[4], row[5], row[6]});
    plot.lines.push_back(std::move(line));
  }
  shown.tables.push_back(std::move(table));
  shown.plots.push_back(std::move(plot));
}

}  // namespace

ShownFile shown_road(const std::filesystem::path& road) {
  const formats::RoadFile file = formats::read_road_file(road);
  ShownFile shown;
  shown.kind = "Road (" + file.kind + ")";
  shown.facts = file.facts;
  for (const std::string& warning : file.warnings) shown.facts.push_back("warning: " + warning);
  for (const formats::TeimOrbitPart& part : file.unused)
    shown.facts.push_back("not used: " + part.name);
  for (const std::string& key : file.kept) shown.facts.push_back("not of the surface: " + key);
  add_heights(file, shown);
  return shown;
}

}  // namespace latsch::cli
