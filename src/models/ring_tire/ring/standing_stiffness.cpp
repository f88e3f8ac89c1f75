// SPDX-License-Identifier: Apache-2.0
// Linearization of the standing tire for small vibrations. With x' the derivative of the belt's
// curve by its parameter s at a tread block and
//   θ = n . dx'/|x'|,  σ = t . dx'/|x'|,  α = a . dx'/|x'|
// and the frame following the belt, (10) is to second order, for a section that stands upright,
//   dT = dp - H θ t - y α t + (H a - y n) dψ - 1/2 H (θ^2 n - 2 θ σ t) + y (α σ t - α θ n + dψ θ t)
// A block with the force F on the tire and the stiffness K_b therefore has the energy 1/2 dT K_b dT
// - F . d²T, plus the contribution of its cell's slope.
#include <Eigen/Core>

#include "models/ring_tire/ring/ring_tire.h"
#include "models/ring_tire/tread/block_arms.h"

namespace latsch::ring_tire {
namespace {

using Eigen::Matrix4d;
using Eigen::Vector4d;

Matrix4d along_axes(const Matrix4d& axes, const Vector4d& values) {
  return axes * values.asDiagonal() * axes.transpose();
}

}  // namespace

void RingTreadContact::add_sticking(const NodeValues& q, CyclicBand& K, CyclicBand& C) const {
  see_touching(q, [&](const BlockState& block) {
    const int segment = patches_[block.patch].segment;
    const Arms arms = arms_at(block.patch,
                              block.station,
                              height(segment, block.line, block.station),
                              line_y_[static_cast<std::size_t>(block.line)]);
    const Eigen::Matrix3d spring = block.share * (tangential_ * Eigen::Matrix3d::Identity() +
                                                  (block.stiffer * normal_ - tangential_) *
                                                      block.normal * block.normal.transpose());
    const Matrix4d turning = arms.turning(block.Fn * block.normal + block.F);
    const CellSquares cell(block.depth, block.half, bottom_);
    const auto depth_by = [&](int m) -> Vector4d {
      return arms.tip_by(m).transpose() * block.normal;
    };
    const auto half_by = [&](int m) -> Vector4d {
      const double half = halves_[static_cast<std::size_t>(m * stride_ + block.station)];
      return (Vector4d() << half * block.normal, 0.0).finished();
    };
    for (int m = 0; m < 4; ++m)
      for (int o = m; o < 4; ++o) {
        K.block(node(segment, m), o - m) +=
            normal_ * cell.by_both * depth_by(m) * half_by(o).transpose() +
            normal_ * half_by(m) *
                (cell.by_both * depth_by(o) + cell.by_half * half_by(o)).transpose();
        const Matrix4d springs = arms.tip_by(m).transpose() * spring * arms.tip_by(o);
        K.block(node(segment, m), o - m) +=
            springs + arms.turning_by(m).transpose() * turning * arms.turning_by(o);
        C.block(node(segment, m), o - m) += damping_time_ * springs;
      }
  });
}

RingTire::Linearized RingTire::linearized() const {
  const int nodes = angles_.nodes();
  const SidewallForces::Losses losses = inner_forces_.sidewall().losses();
  Linearized tire{CyclicBand(nodes),
                  CyclicBand(nodes),
                  CyclicBand(nodes),
                  CyclicBand(nodes),
                  losses.time_constant,
                  {},
                  {}};
  StiffnessRows mass(nodes);
  mass.add_at_knots(mass_.asDiagonal());
  mass.turn_back(rim_, tire.mass);
  imbalance_.add_mass(1.0, tire.mass);
  InnerForces inner = inner_forces_;
  inner.sidewall().stick();
  inner.find_stiffness(q_, rim_, {}, 1.0).turn_back(rim_, tire.stiffness);
  for (int k = 0; k < nodes; ++k) {
    Matrix4d axes = Matrix4d::Identity();
    axes.block<3, 1>(0, 0) = angles_.radial(rim_, k);
    axes.block<3, 1>(0, 1) = angles_.tangential(rim_, k);
    axes.block<3, 1>(0, 2) = rim_.a;
    add_at_knot(along_axes(axes, losses.damping), k, tire.damping);
    add_at_knot(along_axes(axes, losses.maxwell), k, tire.maxwell);
  }
  if (inner.belt().damped()) {
    CyclicBand of_belt(nodes);
    inner.find_belt_damping(q_, rim_).turn_back(rim_, of_belt);
    for (int k = 0; k < nodes; ++k)
      for (int j = 0; j <= CyclicBand::kReach; ++j) tire.damping.block(k, j) += of_belt.block(k, j);
  }
  tread_.add_sticking(q_, tire.stiffness, tire.damping);
  if (section_.on())
    tread_.section_border(section_, q_, true, tire.section_border, tire.section_stiffness);
  return tire;
}

}  // namespace latsch::ring_tire
