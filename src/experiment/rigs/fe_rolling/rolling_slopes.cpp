// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_rolling/rolling_slopes.h"

#include "experiment/rigs/fe_rolling/steady_table.h"
#include "experiment/rigs/fe_tire/rolling_rig.h"

namespace latsch::experiment {

Result<RollingSlopes> rolling_slopes(TireRig& rig,
                                     const RollingStiffnessTest& test,
                                     const WantedSlopes& wanted,
                                     fe_tire::TireSlopes* slopes) {
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
  const auto states = roll_states(rig, rolling, {}, slopes);
  if (!states) return states.failure();
  using Forces = const fe_tire::RollingForces&;
  const auto Fx = [](Forces forces) { return forces.force.x(); };
  const auto Fy = [](Forces forces) { return forces.force.y(); };
  const auto Mz = [](Forces forces) { return forces.moment.z(); };
  // Returns half the change of a value of the forces from a state to its opposite. `of` returns the
  // forces of a state, or their rates.
  const auto odd = [&](std::size_t first, const auto& value, const auto& of) {
    return 0.5 * (value(of((*states)[first])) - value(of((*states)[first + 1])));
  };
  const auto forces = [](const RolledState& rolled) -> Forces { return rolled.state.forces; };
  RollingSlopes found;
  if (wanted.slip) found.slip = odd(slip, Fx, forces) / test.slip;
  double side_force = 0.0;
  if (wanted.cornering) {
    side_force = odd(angle, Fy, forces);
    if (side_force == 0.0)
      return Failure{"slip angle makes no side force: there is no trail to compute"};
    found.cornering = -side_force / test.angle;
    found.trail = -odd(angle, Mz, forces) / side_force;
  }
  if (wanted.camber) found.camber = 0.0 - odd(camber, Fy, forces) / test.camber;
  const std::size_t parameters = states->empty() ? 0 : states->front().rates.size();
  for (std::size_t k = 0; k < parameters; ++k) {
    const auto rates = [k](const RolledState& rolled) -> Forces { return rolled.rates[k].forces; };
    std::array<double, 4>& by = found.rates.emplace_back();
    if (wanted.slip) by[0] = odd(slip, Fx, rates) / test.slip;
    if (wanted.cornering) {
      by[1] = -odd(angle, Fy, rates) / test.angle;
      by[2] = (-odd(angle, Mz, rates) - found.trail * odd(angle, Fy, rates)) / side_force;
    }
    if (wanted.camber) by[3] = 0.0 - odd(camber, Fy, rates) / test.camber;
  }
  return found;
}

}  // namespace latsch::experiment
