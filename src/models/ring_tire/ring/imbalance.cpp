// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/ring/imbalance.h"

#include <cmath>
#include <numbers>

#include "models/ring_tire/belt/belt_curve.h"

namespace latsch::ring_tire {

Imbalance::Imbalance(const Uniformity& uniformity, int nodes)
    : mass_(uniformity.imbalance), node_(), weight_() {
  const double at = uniformity.imbalance_angle * nodes / (2.0 * std::numbers::pi);
  const double segment = std::floor(at);
  weight_ = curve_weights(at - segment).place;
  const int k = static_cast<int>(std::fmod(std::fmod(segment, nodes) + nodes, nodes));
  for (int i = 0; i < 4; ++i) node_[static_cast<std::size_t>(i)] = (k + i - 1 + nodes) % nodes;
}

void Imbalance::add_inertia(const NodeValues& a, NodeValues& force) const {
  if (mass_ == 0.0) return;
  Eigen::Vector3d own = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < 4; ++i) own += weight_[i] * a.col(node_[i]).head<3>();
  for (std::size_t i = 0; i < 4; ++i) force.col(node_[i]).head<3>() += mass_ * weight_[i] * own;
}

/// Calls `add` for every block (k, k + j) of the additional mass matrix.
template <class Add>
void Imbalance::find_mass(double factor, const Add& add) const {
  if (mass_ == 0.0) return;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i; j < 4; ++j) {
      const double m = factor * mass_ * weight_[i] * weight_[j];
      add(node_[i],
          static_cast<int>(j - i),
          CyclicBand::Block(Eigen::Vector4d(m, m, m, 0.0).asDiagonal()));
    }
}

void Imbalance::add_mass(double factor, CyclicBand& K) const {
  find_mass(factor, [&](int k, int j, const CyclicBand::Block& M) { K.block(k, j) += M; });
}

void Imbalance::add_mass(double factor, CyclicBandFactor& K) const {
  find_mass(factor, [&](int k, int j, const CyclicBand::Block& M) { K.add(k, j, M); });
}

void Imbalance::add_weight(double g, NodeValues& force) const {
  if (mass_ == 0.0) return;
  for (std::size_t i = 0; i < 4; ++i) force(2, node_[i]) -= mass_ * g * weight_[i];
}

double Imbalance::height_energy(double g, const NodeValues& q) const {
  double height = 0.0;
  for (std::size_t i = 0; i < 4; ++i) height += weight_[i] * q(2, node_[i]);
  return mass_ * g * height;
}

}  // namespace latsch::ring_tire
