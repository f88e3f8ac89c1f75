// SPDX-License-Identifier: Apache-2.0
// The rim with the angles of the belt's nodes. Node k is at the angle φ_k = 2π k/N of axes that
// rotate with the rim, with e_r = X sin φ - Z cos φ, e_t = X cos φ + Z sin φ and the spin axis a,
// so that e_t × a = -e_r. At spin 0 node 0 points at the road.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "models/tire/tire.h"

namespace latsch::ring_tire {

struct RimFrame {
  Eigen::Vector3d center, X, a, Z;   // inertial; X, a, Z rotate with the rim
  Eigen::Vector3d velocity;          // m/s, of the center
  Eigen::Vector3d angular_velocity;  // rad/s, of the rim
  double spin_rate = 0.0;            // rad/s, about a, relative to the carrier

  static RimFrame of(const WheelMotion& motion);

  /// Returns the matrix with the columns X, a, Z.
  Eigen::Matrix3d axes() const { return (Eigen::Matrix3d() << X, a, Z).finished(); }

  /// Returns the velocity of the rim's material at an inertial point.
  Eigen::Vector3d velocity_at(const Eigen::Vector3d& point) const {
    return velocity + angular_velocity.cross(point - center);
  }
};

/// Sines and cosines of the nodes' angles.
class NodeAngles {
 public:
  explicit NodeAngles(int nodes);

  int nodes() const { return static_cast<int>(sine_.size()); }
  Eigen::Vector3d radial(const RimFrame& rim, int k) const {
    return rim.X * sine_[static_cast<std::size_t>(k)] -
           rim.Z * cosine_[static_cast<std::size_t>(k)];
  }
  Eigen::Vector3d tangential(const RimFrame& rim, int k) const {
    return rim.X * cosine_[static_cast<std::size_t>(k)] +
           rim.Z * sine_[static_cast<std::size_t>(k)];
  }
  const double* sine() const { return sine_.data(); }
  const double* cosine() const { return cosine_.data(); }

 private:
  std::vector<double> sine_, cosine_;
};

/// One column a node: x, y, z (inertial, m) and the section's torsion ψ (rad, about e_t, relative
/// to the rim); or their rates; or forces and the moment conjugate to ψ.
using NodeValues = Eigen::Matrix4Xd;

}  // namespace latsch::ring_tire
