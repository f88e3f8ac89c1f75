// SPDX-License-Identifier: Apache-2.0
// Contact of a wheel with the road plane below it, and the slip there.
//
// W axes: x = spin axis x normal, y = normal x x. The origin is the point where the wheel plane's
// line of steepest descent from the center meets the road plane. gamma = asin(spin axis . normal);
// alpha > 0 if the contact point moves to the left, +y.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "models/road/road.h"
#include "models/tire/tire.h"

namespace latsch::magic_formula {

/// The plane the tire stands on.
struct RoadPlane {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // velocity of the ground
  double friction = 1.0;
};

struct WheelContact {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  // columns: W, inertial
  Eigen::Vector3d point = Eigen::Vector3d::Zero();     // inertial
  double height = 0.0;        // m: from the center down the wheel plane to the road
  double gamma = 0.0;         // rad
  double Vx = 0.0, Vy = 0.0;  // m/s: of the wheel plane's point at the contact over the ground
  double approach = 0.0;      // m/s: of the center toward the road
  double yaw_rate = 0.0;      // rad/s: about the normal
  double friction = 1.0;
};

/// Returns nothing if the spin axis is perpendicular to the road.
std::optional<WheelContact> touch(const WheelMotion& motion, const RoadPlane& plane);

/// Returns the plane tangent to the road at the wheel's contact point.
RoadPlane tangent_plane(const WheelMotion& motion, const road::Road& road, double time);

/// Converts forces and moments in W at the contact point to those on the rim in C.
HubForces at_hub(const WheelMotion& motion,
                 const WheelContact& contact,
                 const Eigen::Vector3d& force,
                 const Eigen::Vector3d& moment);

}  // namespace latsch::magic_formula
