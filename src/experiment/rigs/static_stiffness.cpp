// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/static_stiffness.h"

#include <Eigen/Geometry>
#include <cmath>

#include "experiment/rigs/drum_rig.h"
#include "models/road/plane_road.h"
#include "models/road/profile_road.h"

namespace latsch::experiment {
namespace {

WheelMotion standing(double height) {
  WheelMotion motion;
  motion.center.z() = height;
  return motion;
}

/// A smooth way from 0 to 1 without a jump of acceleration, and its rate by the share of the ramp.
struct Way {
  double place, rate;
};
Way way_at(double share) {
  if (share >= 1.0) return {1.0, 0.0};
  const double s2 = share * share;
  return {s2 * share * (10.0 - 15.0 * share + 6.0 * s2), 30.0 * s2 * (1.0 - share) * (1.0 - share)};
}

WheelMotion moved(const WheelMotion& from, Direction direction, double travel, double rate) {
  WheelMotion motion = from;
  if (direction == Direction::torsional) {
    motion.carrier =
        Eigen::AngleAxisd(travel, Eigen::Vector3d::UnitZ()).toRotationMatrix() * from.carrier;
    motion.angular_velocity.z() = rate;
    return motion;
  }
  const int axis = direction == Direction::longitudinal ? 0 : 1;
  motion.center[axis] += travel;
  motion.velocity[axis] = rate;
  return motion;
}

double reaction(const WheelMotion& motion, const HubForces& hub, Direction direction) {
  if (direction == Direction::torsional) return (motion.carrier * hub.moment).z();
  return (motion.carrier * hub.force)[direction == Direction::longitudinal ? 0 : 1];
}

}  // namespace

Result<double> load_at(Tire& tire, double deflection, const std::optional<Cleat>& cleat) {
  const auto on = [&](const road::Road& ground) -> Result<double> {
    const double height = ground.height(0.0, 0.0, 0.0) + tire.free_radius() - deflection;
    const auto hub = tire.settle(standing(height), ground, 0.0);
    if (!hub) return hub.failure();
    return hub->force.z();
  };
  if (!cleat) return on(road::PlaneRoad());
  return on(road::cleat_road(0.0, cleat->height, cleat->length, cleat->bevel, cleat->angle));
}

Result<double> stiffness(Tire& tire, const StiffnessTest& test) {
  const road::PlaneRoad ground;
  const auto height = height_under_load(tire, ground, Eigen::Matrix3d::Identity(), test.load);
  if (!height) return height.failure();
  if (test.direction == Direction::vertical) {
    const double deflection = tire.free_radius() - *height;
    const auto more = load_at(tire, deflection + test.travel);
    if (!more) return more;
    const auto less = load_at(tire, deflection - test.travel);
    if (!less) return less;
    return (*more - *less) / (2.0 * test.travel);
  }
  const WheelMotion start = standing(*height);
  auto hub = tire.settle(start, ground, 0.0);
  if (!hub) return hub.failure();
  const double before = reaction(start, *hub, test.direction);
  WheelMotion motion = start;
  const long steps = std::lround((test.ramp + test.hold) / test.step);
  for (long i = 1; i <= steps; ++i) {
    const double time = static_cast<double>(i) * test.step;
    const Way way = way_at(time / test.ramp);
    motion =
        moved(start, test.direction, way.place * test.travel, way.rate * test.travel / test.ramp);
    hub = tire.advance(motion, ground, time, test.step);
    if (!hub) return hub.failure();
  }
  return (before - reaction(motion, *hub, test.direction)) / test.travel;
}

}  // namespace latsch::experiment
