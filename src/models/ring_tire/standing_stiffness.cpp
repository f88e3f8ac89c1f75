// SPDX-License-Identifier: Apache-2.0
// The standing tire for small vibrations. With x' the belt's derivative by s at a block and
//   θ = n . dx'/|x'|,  σ = t . dx'/|x'|,  α = a . dx'/|x'|
// (10) with the frame following the belt is to second order, of a section that stands upright,
//   dT = dp - H θ t - y α t + (H a - y n) dψ - 1/2 H (θ^2 n - 2 θ σ t) + y (α σ t - α θ n + dψ θ t)
// so a block with force F on the tire and stiffness K_b has the energy 1/2 dT K_b dT - F . d²T.
#include <Eigen/Core>

#include "models/ring_tire/ring_tire.h"
#include "models/ring_tire/touching_blocks.h"

namespace latsch::ring_tire {
namespace {

using Eigen::Matrix3d;
using Eigen::Matrix4d;
using Eigen::Vector3d;
using Eigen::Vector4d;

/// A block's station: what its four nodes do to its tip.
struct Arms {
  Vector3d t, n, a;
  double length, H, y;
  double w[4], d[4];

  /// dT by x and ψ of node m.
  Eigen::Matrix<double, 3, 4> tip_by(int m) const {
    Eigen::Matrix<double, 3, 4> by;
    by.leftCols<3>() =
        w[m] * Matrix3d::Identity() - (d[m] / length) * t * (H * n + y * a).transpose();
    by.col(3) = w[m] * (H * a - y * n);
    return by;
  }
  /// θ, σ, α and dψ by x and ψ of node m.
  Matrix4d turning_by(int m) const {
    Matrix4d by = Matrix4d::Zero();
    by.row(0).head<3>() = (d[m] / length) * n.transpose();
    by.row(1).head<3>() = (d[m] / length) * t.transpose();
    by.row(2).head<3>() = (d[m] / length) * a.transpose();
    by(3, 3) = w[m];
    return by;
  }
  /// -F . d²T by θ, σ, α and dψ.
  Matrix4d turning(const Vector3d& F) const {
    const double along = F.dot(t), out = F.dot(n);
    Matrix4d K = Matrix4d::Zero();
    K(0, 0) = H * out;
    K(0, 1) = K(1, 0) = -H * along;
    K(0, 2) = K(2, 0) = y * out;
    K(1, 2) = K(2, 1) = -y * along;
    K(0, 3) = K(3, 0) = -y * along;
    return K;
  }
};

Matrix4d along_axes(const Matrix4d& axes, const Vector4d& values) {
  return axes * values.asDiagonal() * axes.transpose();
}

}  // namespace

void TreadContact::add_sticking(const NodeValues& q, CyclicBand& K, CyclicBand& C) const {
  see_touching(q, [&](const BlockState& block) {
    const int j = block.station, segment = patches_[block.patch].segment;
    const auto vector = [&](int c) {
      const auto at = [&](int i) { return frame(block.patch, c + i)[j]; };
      return Vector3d(at(0), at(1), at(2));
    };
    Arms arms{.t = vector(kT),
              .n = vector(kN),
              .a = a_,
              .length = frame(block.patch, kLength)[j],
              .H = line_height_[static_cast<std::size_t>(block.line)],
              .y = line_y_[static_cast<std::size_t>(block.line)],
              .w = {},
              .d = {}};
    for (int m = 0; m < 4; ++m) {
      arms.w[m] = weights_[static_cast<std::size_t>(m * stride_ + j)];
      arms.d[m] = weights_[static_cast<std::size_t>((4 + m) * stride_ + j)];
    }
    const Matrix3d spring = tangential_ * Matrix3d::Identity() +
                            (normal_ - tangential_) * block.normal * block.normal.transpose();
    const Matrix4d turning = arms.turning(block.Fn * block.normal + block.F);
    for (int m = 0; m < 4; ++m)
      for (int o = m; o < 4; ++o) {
        const Matrix4d springs = arms.tip_by(m).transpose() * spring * arms.tip_by(o);
        K.block(node(segment, m), o - m) +=
            springs + arms.turning_by(m).transpose() * turning * arms.turning_by(o);
        C.block(node(segment, m), o - m) += damping_time_ * springs;
      }
  });
}

RingTire::Linearized RingTire::linearized() const {
  const int nodes = angles_.nodes();
  const SidewallForces::Losses losses = wall_.losses();
  Linearized tire{CyclicBand(nodes), CyclicBand(nodes), CyclicBand(nodes), losses.time_constant};
  belt_.add_stiffness(q_, rim_, 1.0, tire.stiffness);
  SidewallForces wall = wall_;
  wall.stick();
  wall.add_stiffness(q_, rim_, {}, 1.0, tire.stiffness);
  for (int k = 0; k < nodes; ++k) {
    Matrix4d axes = Matrix4d::Identity();
    axes.block<3, 1>(0, 0) = angles_.radial(rim_, k);
    axes.block<3, 1>(0, 1) = angles_.tangential(rim_, k);
    axes.block<3, 1>(0, 2) = rim_.a;
    tire.damping.block(k, 0) += along_axes(axes, losses.damping);
    tire.maxwell.block(k, 0) += along_axes(axes, losses.maxwell);
  }
  tread_.add_sticking(q_, tire.stiffness, tire.damping);
  return tire;
}

}  // namespace latsch::ring_tire
