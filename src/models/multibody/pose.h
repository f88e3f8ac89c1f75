// SPDX-License-Identifier: Apache-2.0
// Pose of a rigid body. Axes are ISO 8855: x forward, y left, z up.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <utility>

namespace latsch::multibody {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// Returns sin θ/θ and (1 - cos θ)/θ² as functions of z = θ². For small z it uses the Taylor
/// series, of which seven terms are exact to rounding.
inline std::pair<double, double> rotation_series(double z) {
  constexpr double kNear = 0.25;
  if (z < kNear)
    return {
        1.0 + z * (-1.0 / 6 + z * (1.0 / 120 + z * (-1.0 / 5040 +
                                                    z * (1.0 / 362880 + z * (-1.0 / 39916800 +
                                                                             z / 6227020800.0))))),
        0.5 + z * (-1.0 / 24 +
                   z * (1.0 / 720 +
                        z * (-1.0 / 40320 +
                             z * (1.0 / 3628800 + z * (-1.0 / 479001600 + z / 87178291200.0)))))};
  const double angle = std::sqrt(z);
  return {std::sin(angle) / angle, (1.0 - std::cos(angle)) / z};
}

struct Pose {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  // m, position of the body's origin
  // Rotation matrix from the body's axes to those of the ground.
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();

  Eigen::Vector3d at(const Eigen::Vector3d& in_body) const { return place + turn * in_body; }
  /// Translates the origin, then rotates by the rotation vector r, both in the ground's axes:
  ///   turn <- (1 + sin θ/θ r× + (1 - cos θ)/θ² r× r×) turn,  θ = |r|           Rodrigues
  void move(const Vector6d& by) {
    place += by.head<3>();
    const Eigen::Vector3d r = by.tail<3>();
    const auto [sine, cosine] = rotation_series(r.squaredNorm());
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d axis = turn.col(i), once = r.cross(axis);
      turn.col(i) = axis + (sine * once + cosine * r.cross(once));
    }
  }
  bool operator==(const Pose&) const = default;
};

/// Returns the matrix of the cross product: cross(a) b = a × b.
inline Eigen::Matrix3d cross(const Eigen::Vector3d& a) {
  Eigen::Matrix3d m;
  m << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return m;
}

}  // namespace latsch::multibody
