// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/belt/stiffness_rows.h"

#define LATSCH_KERNELS_IN "models/ring_tire/belt/stiffness_rows_kernels.h"
#include "numerics/kernels/for_each_kernel_set.h"

namespace latsch::ring_tire {

StiffnessRows::StiffnessRows(int nodes)
    : nodes_(nodes),
      memory_(static_cast<std::size_t>((kOwn + kScratch) * (nodes + 2 * kBeyond)), 0.0) {
  start();
}

void StiffnessRows::start() {
  for (Eigen::Matrix4d& block : same_) block.setZero();
}

void StiffnessRows::add_at_knots(const Eigen::Matrix4d& k) {
  same_[0] += 18.0 / 36.0 * k;
  same_[1] += 8.0 / 36.0 * k;
  same_[2] += 1.0 / 36.0 * k;
}

void StiffnessRows::fill_panels(double* panels) const {
  for (int j = 0; j <= CyclicBand::kReach; ++j) {
    const double* rows[kEntries];
    for (int entry = 0; entry < kEntries; ++entry) rows[entry] = at(j * kEntries + entry);
    LATSCH_KERNEL(fill_panels)
    (nodes_, rows, same_[static_cast<std::size_t>(j)].data(), panels + 4 * j);
  }
}

void StiffnessRows::turn_back(const RimFrame& rim, CyclicBand& K) const {
  const Eigen::Matrix3d axes = rim.axes();
  Eigen::Matrix4d turn = Eigen::Matrix4d::Identity();
  turn.topLeftCorner<3, 3>() = axes;
  for (int j = 0; j <= CyclicBand::kReach; ++j) {
    const double* rows[kEntries];
    for (int entry = 0; entry < kEntries; ++entry) rows[entry] = at(j * kEntries + entry);
    const Eigen::Matrix4d same = turn * same_[static_cast<std::size_t>(j)] * turn.transpose();
    LATSCH_KERNEL(turn_blocks)
    (nodes_, rows, axes.data(), same.data(), K.block(0, j).data(), 16 * (CyclicBand::kReach + 1));
  }
}

}  // namespace latsch::ring_tire
