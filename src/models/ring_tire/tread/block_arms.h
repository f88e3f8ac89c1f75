// SPDX-License-Identifier: Apache-2.0
// Dependence of a block's tip on the four nodes of its segment.
#pragma once

#include <Eigen/Core>

#include "models/ring_tire/tread/touching_blocks.h"

namespace latsch::ring_tire {

/// A block's station: the effect of its four nodes on its tip.
struct RingTreadContact::Arms {
  Eigen::Vector3d t, n, a;
  double length, H, y;
  double w[4], d[4];

  /// Returns dT by x and ψ of node m.
  Eigen::Matrix<double, 3, 4> tip_by(int m) const {
    Eigen::Matrix<double, 3, 4> by;
    by.leftCols<3>() =
        w[m] * Eigen::Matrix3d::Identity() - (d[m] / length) * t * (H * n + y * a).transpose();
    by.col(3) = w[m] * (H * a - y * n);
    return by;
  }
  /// Returns θ, σ, α and dψ by x and ψ of node m.
  Eigen::Matrix4d turning_by(int m) const {
    Eigen::Matrix4d by = Eigen::Matrix4d::Zero();
    by.row(0).head<3>() = (d[m] / length) * n.transpose();
    by.row(1).head<3>() = (d[m] / length) * t.transpose();
    by.row(2).head<3>() = (d[m] / length) * a.transpose();
    by(3, 3) = w[m];
    return by;
  }
  /// Returns -F . d²T by θ, σ, α and dψ.
  Eigen::Matrix4d turning(const Eigen::Vector3d& F) const {
    const double along = F.dot(t), out = F.dot(n);
    Eigen::Matrix4d K = Eigen::Matrix4d::Zero();
    K(0, 0) = H * out;
    K(0, 1) = K(1, 0) = -H * along;
    K(0, 2) = K(2, 0) = y * out;
    K(1, 2) = K(2, 1) = -y * along;
    K(0, 3) = K(3, 0) = -y * along;
    return K;
  }
};

inline RingTreadContact::Arms RingTreadContact::arms_at(std::size_t patch,
                                                        int station,
                                                        double H,
                                                        double y) const {
  const auto vector = [&](int c) {
    const auto at = [&](int i) { return frame(patch, c + i)[station]; };
    return Eigen::Vector3d(at(0), at(1), at(2));
  };
  Arms arms{.t = vector(kT),
            .n = vector(kN),
            .a = a_,
            .length = frame(patch, kLength)[station],
            .H = H,
            .y = y,
            .w = {},
            .d = {}};
  for (int m = 0; m < 4; ++m) {
    arms.w[m] = weights_[static_cast<std::size_t>(m * stride_ + station)];
    arms.d[m] = weights_[static_cast<std::size_t>((4 + m) * stride_ + station)];
  }
  return arms;
}

}  // namespace latsch::ring_tire
