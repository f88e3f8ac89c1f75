// SPDX-License-Identifier: Apache-2.0
// Where a rigid body stands. Axes: ISO 8855, x forward, y left, z up.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace latsch::multibody {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

struct Pose {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();     // of the body's origin, m
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  // from the body's axes to the ground's

  Eigen::Vector3d at(const Eigen::Vector3d& in_body) const { return place + turn * in_body; }
  /// Travel of the origin, then a rotation by its vector, both in the ground's axes.
  void move(const Vector6d& by) {
    place += by.head<3>();
    const Eigen::Vector3d rotation = by.tail<3>();
    const double angle = rotation.norm();
    if (angle > 0.0) turn = Eigen::AngleAxisd(angle, rotation / angle).toRotationMatrix() * turn;
  }
  bool operator==(const Pose&) const = default;
};

/// cross(a) b = a × b.
inline Eigen::Matrix3d cross(const Eigen::Vector3d& a) {
  Eigen::Matrix3d m;
  m << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return m;
}

}  // namespace latsch::multibody
