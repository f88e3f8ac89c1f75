// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_rolling/patch_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace latsch::experiment {

std::string words_on_sectors(const TireRig& rig, const RollingTest& test) {
  constexpr double kFewest = 2.0;  // sectors in the lower bound; patches have about twice as many
  const fe_tire::Mesh& mesh = rig.tire().mesh();
  const double sector = mesh.outer_radius() * mesh.angle(1);
  const double width = mesh.X.row(1).maxCoeff() - mesh.X.row(1).minCoeff();
  const double usual = test.pressure.value_or(rig.own_pressure());
  double shortest = std::numeric_limits<double>::infinity();
  for (const RollingRow& row : test.rows)
    shortest = std::min(shortest, row.load / row.pressure.value_or(usual) / width);
  if (!(shortest < kFewest * sector)) return "";
  return fmt::format(
      "sectors at the ground are {:.0f} mm long, and the shortest patch is hardly longer than "
      "{:.0f} "
      "mm: slip and side forces of so few points depend on the mesh, often by a factor, and powers "
      "need not balance (channel balance of a test rolling); narrow the sectors there "
      "(mesh.sector_zones, or mesh.sectors) until they stay",
      1e3 * sector,
      1e3 * shortest);
}

Status check_drum(const fe_tire::RollingState& state, double drum_radius) {
  constexpr double kFarthest = 0.5;  // rad
  if (!(drum_radius > 0.0)) return {};
  double reach = 0.0;  // m, along the surface rolled out
  for (const fe_tire::RollingPatchPoint& point : state.patch)
    reach = std::max(reach, std::abs(point.x) + 0.5 * point.length);
  if (reach <= kFarthest * drum_radius) return {};
  return Failure{fmt::format(
      "the drum's radius is {:.4g} mm, and the patch reaches {:.4g} mm along it, more than half a "
      "radian: expected a larger one, at least {:.4g} mm, or less load",
      1e3 * drum_radius,
      1e3 * reach,
      1e3 * reach / kFarthest)};
}

}  // namespace latsch::experiment
