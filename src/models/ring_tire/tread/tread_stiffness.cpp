// SPDX-License-Identifier: Apache-2.0
// Stiffness of the tread blocks: sums over the lines at a station, then to its four nodes.
//
// With K of one block, (10) gives dT = dp - H t dν_n - y t dν_a + (H a - y n) dψ, and
//   dp = Σ w_m dx_m,  dν_n = Σ d_m n . dx_m/|x'|,  dν_a = Σ d_m a . dx_m/|x'|,  dψ = Σ w_m dψ_m
// so a pair of nodes m, m' gets w w' M_ww + w d' M_wd + d w' M_wd^T + d d' M_dd. H is the same for
// all lines here: the crown's curvature of millimeters matters for forces, not for their
// derivatives.
#include "models/ring_tire/tread/block_forces.h"
#include "models/ring_tire/tread/tread_contact.h"

#define LATSCH_KERNELS_IN "models/ring_tire/tread/stiffness_kernels.h"
#include "numerics/kernels/for_each_kernel_set.h"

namespace latsch::ring_tire {

/// Calls `add` with the blocks (k, k + j) of every patch, in rotated axes.
template <class Add>
void RingTreadContact::find_stiffness(double scale, const Eigen::Matrix3d& axes, const Add& add) {
  const double rate = 1.0 + (rule_.statics() ? 0.0 : damping_time_ * rule_.velocity);
  const double normal = scale * normal_ * rate, tangential = scale * tangential_ * rate;
  for (std::size_t i = 0; i < patches_.size(); ++i) {
    const Patch& patch = patches_[i];
    const BlockSpan span{stride_, patch.begin, patch.end};
    if (patch.level)
      level_stiffness(span, lines(), results(i), normal, tangential, at_stations(0));
    else
      uneven_stiffness(span, lines(), ground(i), results(i), normal, tangential, at_stations(0));
    // All stations are computed first and used afterward, because reading a station at once would
    // wait for it.
    StationStiffness* const stations = station_stiffness_.data();
    LATSCH_KERNEL(find_station_stiffness)
    (span, at_stations(0), frame(i, 0), a_.data(), axes.data(), height_, stations);
    Eigen::Matrix4d pairs[10];
    LATSCH_KERNEL(sum_pairs)
    (stations, patch.begin, std::min(patch.end, blocks_), pair_weights_.data(), pairs);
    const Eigen::Matrix4d* pair = pairs;
    for (int m = 0; m < 4; ++m)
      for (int o = m; o < 4; ++o) add(node(patch.segment, m), o - m, *pair++);
  }
}

void RingTreadContact::add_stiffness(double scale, CyclicBand& K) {
  find_stiffness(scale,
                 Eigen::Matrix3d::Identity(),
                 [&](int k, int j, const Eigen::Matrix4d& block) { K.block(k, j) += block; });
}

void RingTreadContact::add_stiffness(double scale,
                                     const Eigen::Matrix3d& axes,
                                     CyclicBandFactor& K) {
  find_stiffness(
      scale, axes, [&](int k, int j, const Eigen::Matrix4d& block) { K.add(k, j, block); });
}

}  // namespace latsch::ring_tire
