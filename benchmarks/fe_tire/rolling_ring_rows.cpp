// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "rolling_rings.h"
#include "rolling_rows.h"

namespace latsch::benchmarks {
namespace {

using namespace verification;

/// The largest errors of Q/(mu P), relative, and of the border of stick, in elements. `drum`: its
/// radius, m; 0: flat ground.
void roll_carter(bool lateral, double drum, int across, Table& table) {
  CarterRing carter(across, drum);
  const double a = fit_hertz(carter.ring().free_wheel()).a;
  const double place = 2.0 * CarterRing::kHalf / across;
  double force = 0.0, border = 0.0;
  for (const CarterRing::Slip& slip : CarterRing::kSlips) {
    const double share = slip.share;
    const double along =
        CarterRing::kMu * a / CarterRing::radius(drum) * (1.0 - std::sqrt(1.0 - share));
    const fe_tire::RollingState state =
        lateral ? carter.ring().slipping(0.0, std::atan(along / (1.0 - CarterRing::kNu)))
                : carter.ring().slipping(along, 0.0);
    const Eigen::Vector3d& F = state.forces.force;
    const double Q = (lateral ? -F.y() : F.x()) / (CarterRing::kMu * F.z());
    force = std::max(force, std::abs(Q / (lateral ? slip.lateral : slip.along) - 1.0));
    double least = 1.0;
    for (const auto& point : state.patch)
      if (point.line == 2 && point.sticks) least = std::min(least, point.x);
    border = std::max(border, std::abs(least - a * (1.0 - 2.0 * std::sqrt(1.0 - share))) / place);
  }
  const std::string way = std::string(lateral ? "lateral" : "longitudinal") +
                          (drum > 0.0 ? fmt::format(", drum of {:g} m", drum) : std::string());
  table.row(fmt::format("thick ring, {} elements across, {}: Q at Carter's creep", across, way),
            fmt::format("{:.2f} %", 1e2 * force),
            "<= 2 %",
            force <= 0.02);
  if (drum > 0.0 && lateral) return;  // a steered ring touches a drum along a slanted line
  table.row(fmt::format("thick ring, {}: border of stick", way),
            fmt::format("{:.2f} elements", border),
            "<= 1",
            border <= 1.0);
}

void roll_brush(int across, Table& table) {
  BrushRing brush(across);
  const HertzFit fit = fit_parabola(brush.ring().free_wheel());
  const double full = BrushRing::kMu * 2.0 * fit.p_0 / (fit.a * BrushRing::stiffness());
  double force = 0.0, trail = 0.0;
  for (const double s : {0.2, 0.4, 0.6}) {
    const fe_tire::RollingState state = brush.ring().slipping(0.0, std::atan(s * full));
    const Eigen::Vector3d& F = state.forces.force;
    const double share = s * (3.0 - 3.0 * s + s * s);
    force = std::max(force, std::abs(-F.y() / (BrushRing::kMu * F.z()) / share - 1.0));
    const double exact = std::pow(1.0 - s, 3) / (3.0 - 3.0 * s + s * s);
    trail = std::max(trail, std::abs(-state.forces.moment.z() / F.y() / fit.a - exact));
  }
  table.row(fmt::format("columns on a rigid rim, {} elements across: force of the brush", across),
            fmt::format("{:.2f} %", 1e2 * force),
            "<= 3 %",
            force <= 0.03);
  table.note("columns on a rigid rim: trail of the brush", fmt::format("{:.4f} a", trail));
}

}  // namespace

void roll_rings(const Options& options, Table& table) {
  const int across = options.size(80, 40);
  for (const double drum : {0.0, 0.6}) {
    if (drum > 0.0 && options.is_smoke()) break;
    roll_carter(false, drum, across, table);
    roll_carter(true, drum, across, table);
  }
  roll_brush(across, table);
}

}  // namespace latsch::benchmarks
