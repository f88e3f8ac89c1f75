// SPDX-License-Identifier: Apache-2.0
#include "experiment/flat_track.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "experiment/drum_rig.h"
#include "models/road/plane_road.h"

namespace latsch::experiment {
namespace {

constexpr double kWheelInertia = 1.0;  // kg m^2, of the wheel that looks for its free rolling speed

/// Yawed against the belt: with the heading turned right by α the belt carries the wheel to the
/// left of where it looks.
Eigen::Matrix3d carrier_at(double alpha, double camber) {
  return (Eigen::AngleAxisd(-alpha, Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(camber, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

}  // namespace

Result<Channels> run(Tire& tire, const SlipSweep& sweep) {
  const road::PlaneRoad belt({.belt = sweep.speed});
  WheelMotion motion;
  motion.carrier = carrier_at(0.0, sweep.camber);
  const auto height = height_under_load(tire, road::PlaneRoad(), motion.carrier, sweep.load);
  if (!height) return height.failure();
  motion.center.z() = *height;
  motion.spin_rate = sweep.speed / (tire.free_radius() - 0.35 * (tire.free_radius() - *height));
  auto hub = tire.settle(motion, road::PlaneRoad(), 0.0);
  const long free = std::lround(sweep.run_in / sweep.step);
  const long ramp = std::lround(0.5 * sweep.run_in / sweep.step);
  const long swept = std::lround(sweep.duration / sweep.step);
  double free_rate = motion.spin_rate;
  std::array<std::vector<double>, 9> rows;
  for (long i = 1; hub && i <= free + ramp + swept; ++i) {
    const double time = static_cast<double>(i) * sweep.step;
    if (i <= free) {
      motion.spin_rate += sweep.step * hub->moment.y() / kWheelInertia;
      free_rate = motion.spin_rate;
    }
    const double entry = std::clamp(static_cast<double>(i - free) / ramp, 0.0, 1.0);
    const double share = std::clamp(static_cast<double>(i - free - ramp) / swept, 0.0, 1.0);
    const double alpha = entry * (sweep.alpha_from + share * (sweep.alpha_to - sweep.alpha_from));
    const double kappa = entry * (sweep.kappa_from + share * (sweep.kappa_to - sweep.kappa_from));
    motion.carrier = carrier_at(alpha, sweep.camber);
    if (i > free) motion.spin_rate = free_rate * (1.0 + kappa) * std::cos(alpha);
    motion.spin += sweep.step * motion.spin_rate;
    hub = tire.advance(motion, belt, time, sweep.step);
    if (!hub || i <= free + ramp) continue;
    const std::array<double, 9> row = {time,
                                       alpha,
                                       kappa,
                                       hub->force.x(),
                                       hub->force.y(),
                                       hub->force.z(),
                                       hub->moment.x(),
                                       hub->moment.y(),
                                       hub->moment.z()};
    for (std::size_t c = 0; c < row.size(); ++c) rows[c].push_back(row[c]);
  }
  if (!hub) return Failure{"on the flat track: " + hub.failure().reason};
  constexpr const char* kNames[] = {"time", "alpha", "kappa", "Fx", "Fy", "Fz", "Mx", "My", "Mz"};
  constexpr const char* kUnits[] = {"s", "rad", "1", "N", "N", "N", "N m", "N m", "N m"};
  Channels channels;
  for (std::size_t c = 0; c < rows.size(); ++c) channels.add({kNames[c], kUnits[c], rows[c]});
  return channels;
}

}  // namespace latsch::experiment
