// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_rolling/rolling_slopes.h"

#include "experiment/rigs/fe_rolling/steady_table.h"
#include "experiment/rigs/fe_tire/rolling_rig.h"

namespace latsch::experiment {

Result<RollingSlopes> rolling_slopes(TireRig& rig,
                                     const RollingStiffnessTest& test,
                                     const WantedSlopes& wanted) {
  RollingTest rolling{.pressure = test.pressure, .rows = {}};
  const auto add_pair = [&](double kappa, double alpha, double camber, bool is_free) {
    const std::size_t first = rolling.rows.size();
    for (const double sign : {1.0, -1.0}) {
      RollingRow row{test.load, test.speed};
      if (!is_free) row.kappa = sign * kappa;
      row.alpha = sign * alpha;
      row.camber = sign * camber;
      rolling.rows.push_back(row);
    }
    return first;
  };
  const std::size_t slip = wanted.slip ? add_pair(test.slip, 0.0, 0.0, false) : 0;
  const std::size_t angle = wanted.cornering ? add_pair(0.0, test.angle, 0.0, false) : 0;
  const std::size_t camber = wanted.camber ? add_pair(0.0, 0.0, test.camber, true) : 0;
  const auto states = roll_states(rig, rolling);
  if (!states) return states.failure();
  const auto odd_part = [&](std::size_t first, const auto& value) {
    return 0.5 * (value((*states)[first].state.forces) - value((*states)[first + 1].state.forces));
  };
  using Forces = const fe_tire::RollingForces&;
  const auto Fx = [](Forces forces) { return forces.force.x(); };
  const auto Fy = [](Forces forces) { return forces.force.y(); };
  const auto Mz = [](Forces forces) { return forces.moment.z(); };
  RollingSlopes found;
  if (wanted.slip) found.slip = odd_part(slip, Fx) / test.slip;
  if (wanted.cornering) {
    const double side_force = odd_part(angle, Fy);
    if (side_force == 0.0)
      return Failure{"slip angle makes no side force: there is no trail to compute"};
    found.cornering = -side_force / test.angle;
    found.trail = -odd_part(angle, Mz) / side_force;
  }
  if (wanted.camber) found.camber = 0.0 - odd_part(camber, Fy) / test.camber;
  return found;
}

}  // namespace latsch::experiment
