// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/passage/wheel_moment.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "models/fe_tire/contact/ground.h"

namespace latsch::fe_tire {

double SpinningWheel::sum(double spin, double of_tire) const {
  const double others = of_tire + moment + by_spin * (spin - by_spin_at);
  if (spin == 0.0) return others - std::clamp(others, -brake, brake);
  return others - std::copysign(brake, spin);
}

TransientForces on_hub(const RollingCase& of,
                       const RollingForces& ground,
                       const Eigen::Vector3d& inertia,
                       const Eigen::Vector3d& moment_of_inertia) {
  TransientForces found;
  found.ground = ground;
  found.height = of.height;
  const PosedGround posed({}, {.height = of.height, .camber = of.camber});
  const Eigen::Vector3d hub = posed.in_ground(Eigen::Vector3d::Zero());
  const Eigen::Vector3d down = posed.in_ground(-Eigen::Vector3d::UnitZ()) - hub;
  const Eigen::Vector3d arm = hub.z() / -down.z() * down;  // to the contact center
  const Eigen::Vector3d about_hub = ground.moment + arm.cross(ground.force);
  found.force = posed.to_wheel(ground.force) - inertia;
  found.moment = posed.to_wheel(about_hub) - moment_of_inertia;
  return found;
}

RollingCase case_of(const WheelMoment& to) {
  RollingCase of = to.of;
  of.load = to.load;
  of.drive.reset();
  return of;
}

Status check_reach(const std::vector<RollingPatchPoint>& patch, double reach, double touching) {
  for (const RollingPatchPoint& point : patch) {
    if (std::abs(point.x) < reach) continue;
    return Failure{fmt::format(
        "the ground reaches the tread {:.3g} mm {} the axle, and only {:.3g} rad of the tread to "
        "both sides of the lowest point may touch",
        1e3 * std::abs(point.x),
        point.x > 0.0 ? "ahead of" : "behind",
        touching)};
  }
  return {};
}

Status check_spin(double spin, double first_spin) {
  if (kSlowest * spin >= first_spin) return {};
  return Failure{
      fmt::format("the wheel turns at {:.4g} rad/s, more than {:g} times slower than the {:.4g} "
                  "rad/s with which it began to roll: a wheel that locks is not computed",
                  spin,
                  kSlowest,
                  first_spin)};
}

}  // namespace latsch::fe_tire
