// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/belt/belt_damping.h"

#include "models/ring_tire/belt/bend_forms.h"

namespace latsch::ring_tire {
namespace {

using Eigen::Matrix4d;

/// Returns D of one strain of viscosity c, by forms.
BendMatrix turning(const Strain& e, double viscosity, const BendVector& rate) {
  return viscosity * (e.slope.dot(rate) * e.second + e.slope * (e.second * rate).transpose());
}

/// Returns D of the product of two strains, each of which gives the stress of the other.
BendMatrix turning(const Strain& a, const Strain& b, double viscosity, const BendVector& rate) {
  return viscosity * (a.slope.dot(rate) * b.second + b.slope * (a.second * rate).transpose() +
                      b.slope.dot(rate) * a.second + a.slope * (b.second * rate).transpose());
}

}  // namespace

WholeBand::WholeBand(int nodes)
    : nodes_(nodes), blocks_(static_cast<std::size_t>(nodes * kWidth), Matrix4d::Zero()) {}

SideBySide WholeBand::multiply(const SideBySide& x) const {
  SideBySide y = SideBySide::Zero(x.rows(), x.cols());
  for (int k = 0; k < nodes_; ++k)
    for (int j = -CyclicBand::kReach; j <= CyclicBand::kReach; ++j)
      y.middleRows<4>(4 * k).noalias() +=
          block(k, j) * x.middleRows<4>(4 * ((k + j + nodes_) % nodes_));
  return y;
}

SideBySide WholeBand::multiply_transposed(const SideBySide& x) const {
  SideBySide y = SideBySide::Zero(x.rows(), x.cols());
  for (int k = 0; k < nodes_; ++k)
    for (int j = -CyclicBand::kReach; j <= CyclicBand::kReach; ++j)
      y.middleRows<4>(4 * ((k + j + nodes_) % nodes_)).noalias() +=
          block(k, j).transpose() * x.middleRows<4>(4 * k);
  return y;
}

WholeBand damping_by_places(const BeltForces& belt,
                            const RimRows& at,
                            const RimRows& rate,
                            const RimFrame& rim) {
  const BeltLaw& law = belt.law();
  const int N = at.nodes();
  const double cube = law.L0 * law.L0 * law.L0, tau = law.damping_time;
  Matrix4d axes = Matrix4d::Identity();
  axes.topLeftCorner<3, 3>() = rim.axes();
  WholeBand D(N);
  for (const BendPlace& place : {BendPlace::at_knot(law), BendPlace::middle(law)})
    for (int k = 0; k < N; ++k) {
      const Strains e(place, bend_forms(place.rule, at, k));
      const BendVector v = bend_forms(place.rule, rate, k);
      BendMatrix sum = turning(e.bend, tau * place.share * law.EI / cube, v) +
                       turning(e.lateral, tau * place.share * law.EI_out_of_plane / cube, v);
      if (place.between)
        sum += turning(e.twist, tau * law.GJ / law.L0, v) +
               turning(e.length,
                       law.extension_damping_time * law.EA * law.L0 / (law.stretch0 * law.stretch0),
                       v);
      if (law.D16 != 0.0)
        sum += turning(e.bend, e.twist, tau * place.share * law.D16 / (law.L0 * law.L0), v);
      const int nodes = place.between ? 4 : 3;
      for (int i = 0; i < nodes; ++i)
        for (int j = 0; j < nodes; ++j)
          D.block((k + i - 1 + N) % N, j - i) +=
              axes * on_nodes(place.rule, sum, i, j) * axes.transpose();
    }
  return D;
}

}  // namespace latsch::ring_tire
