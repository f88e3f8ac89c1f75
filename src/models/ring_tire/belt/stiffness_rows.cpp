// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/belt/stiffness_rows.h"

#define LATSCH_KERNELS_IN "models/ring_tire/belt/stiffness_rows_kernels.h"
#include "numerics/kernels/for_each_kernel_set.h"

namespace latsch::ring_tire {

StiffnessRows::StiffnessRows(int nodes, int more)
    : nodes_(nodes),
      memory_(static_cast<std::size_t>((kOwn + more) * (nodes + 2 * kBeyond)), 0.0) {}

void StiffnessRows::add_to(CyclicBand& K, const RimFrame& rim) {
  const Eigen::Matrix3d axes = rim.axes();
  for (int j = 0; j <= CyclicBand::kReach; ++j) {
    const double* rows[kEntries];
    for (int entry = 0; entry < kEntries; ++entry) rows[entry] = row(j, static_cast<Entry>(entry));
    LATSCH_KERNEL(add_turned)
    (nodes_, rows, axes.data(), K.block(0, j).data(), 16 * (CyclicBand::kReach + 1));
  }
}

}  // namespace latsch::ring_tire
