// SPDX-License-Identifier: Apache-2.0
#include "models/magic_formula/wheel_contact.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace latsch::magic_formula {

std::optional<WheelContact> touch(const WheelMotion& motion, const RoadPlane& plane) {
  const Eigen::Vector3d spin_axis = motion.carrier.col(1), &n = plane.normal;
  const Eigen::Vector3d forward = spin_axis.cross(n);
  constexpr double kFlat = 1e-3;  // smallest sine of the angle between spin axis and road normal
  if (forward.norm() < kFlat) return std::nullopt;
  WheelContact c;
  c.axes.col(0) = forward.normalized();
  c.axes.col(1) = n.cross(c.axes.col(0));
  c.axes.col(2) = n;
  const Eigen::Vector3d up = c.axes.col(0).cross(spin_axis);  // direction up in the wheel plane
  c.height = n.dot(motion.center - plane.point) / n.dot(up);
  c.point = motion.center - c.height * up;
  c.gamma = std::asin(std::clamp(spin_axis.dot(n), -1.0, 1.0));
  const Eigen::Vector3d velocity =
      motion.velocity + motion.angular_velocity.cross(c.point - motion.center) - plane.velocity;
  c.Vx = velocity.dot(c.axes.col(0));
  c.Vy = velocity.dot(c.axes.col(1));
  c.approach = -velocity.dot(n) / n.dot(up);
  c.yaw_rate = motion.angular_velocity.dot(n);
  c.friction = plane.friction;
  return c;
}

RoadPlane tangent_plane(const WheelMotion& motion, const road::Road& road, double time) {
  RoadPlane plane;
  Eigen::Vector3d below = motion.center;
  // With camber or on a slope the contact point is not exactly below the wheel center. It is found
  // by iteration; three iterations suffice.
  for (int look = 0; look < 3; ++look) {
    const road::GroundPoint ground = road.at(below.x(), below.y(), time);
    plane = {
        {below.x(), below.y(), ground.height}, ground.normal, ground.velocity, ground.friction};
    const auto contact = touch(motion, plane);
    if (!contact) break;
    below = contact->point;
  }
  return plane;
}

HubForces at_hub(const WheelMotion& motion,
                 const WheelContact& contact,
                 const Eigen::Vector3d& force,
                 const Eigen::Vector3d& moment) {
  const Eigen::Vector3d f = contact.axes * force;
  const Eigen::Vector3d m = contact.axes * moment + (contact.point - motion.center).cross(f);
  return {motion.carrier.transpose() * f, motion.carrier.transpose() * m};
}

}  // namespace latsch::magic_formula
