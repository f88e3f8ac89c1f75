// SPDX-License-Identifier: Apache-2.0
// Contact of a wheel with the road plane below it, and the slip there.
//
// Axes W: the x axis is the cross product of spin axis and road normal, the y axis that of normal
// and x axis. The origin is the point where the wheel plane's line of steepest descent from the
// center meets the road plane. gamma = asin(spin axis . normal); alpha > 0 if the contact point
// moves to the left, +y.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "models/road/road.h"
#include "models/tire/tire.h"

namespace latsch::magic_formula {

/// Plane of the road on which the tire stands.
struct RoadPlane {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // m/s, velocity of the ground
  double friction = 1.0;
};

struct WheelContact {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  // columns: axes W in the inertial frame
  Eigen::Vector3d point = Eigen::Vector3d::Zero();     // inertial
  double height = 0.0;  // m, distance in the wheel plane from the center down to the road
  double gamma = 0.0;   // rad
  // Velocity of the wheel plane's point at the contact relative to the ground, m/s.
  double Vx = 0.0, Vy = 0.0;
  double approach = 0.0;  // m/s, velocity of the wheel center toward the road
  double yaw_rate = 0.0;  // rad/s, rotation about the road normal
  double friction = 1.0;
};

/// Returns the contact of the wheel with the plane, or nothing if the spin axis is perpendicular to
/// the plane.
std::optional<WheelContact> touch(const WheelMotion& motion, const RoadPlane& plane);

/// Returns the plane that is tangent to the road at the wheel's contact point.
RoadPlane tangent_plane(const WheelMotion& motion, const road::Road& road, double time);

/// Converts forces and moments at the contact point in axes W to those on the rim at the wheel
/// center in axes C.
HubForces at_hub(const WheelMotion& motion,
                 const WheelContact& contact,
                 const Eigen::Vector3d& force,
                 const Eigen::Vector3d& moment);

}  // namespace latsch::magic_formula
