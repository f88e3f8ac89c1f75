// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/belt/rim_rows.h"

namespace latsch::ring_tire {

struct Rows {
  double *x, *y, *z, *torsion;
};
struct ConstRows {
  const double *x, *y, *z, *torsion;
};

}  // namespace latsch::ring_tire

#define LATSCH_KERNELS_IN "models/ring_tire/belt/rim_kernels.h"
#include "numerics/kernels/for_each_kernel_set.h"

namespace latsch::ring_tire {

RimRows::RimRows(int nodes, int more)
    : nodes_(nodes), memory_(static_cast<std::size_t>((kRows + more) * (nodes + 2 * kBeyond))) {}

void RimRows::close() {
  for (int i = 0; i < kRows; ++i)
    for (int k = 0; k < kBeyond; ++k) {
      row(i)[-1 - k] = row(i)[nodes_ - 1 - k];
      row(i)[nodes_ + k] = row(i)[k];
    }
}

void RimRows::place(const NodeValues& q, const RimFrame& rim) {
  const Eigen::Matrix3d axes = rim.axes();
  LATSCH_KERNEL(turn_to_rim)
  (nodes_, q.data(), rim.center.data(), axes.data(), {row(kX), row(kY), row(kZ), row(kTorsion)});
  close();
}

void RimRows::place_rates(const RimRows& at, const NodeValues& v, const RimFrame& rim) {
  const Eigen::Matrix3d axes = rim.axes();
  LATSCH_KERNEL(turn_to_rim)
  (nodes_, v.data(), rim.velocity.data(), axes.data(), {row(kX), row(kY), row(kZ), row(kTorsion)});
  const Eigen::Vector3d omega = axes.transpose() * rim.angular_velocity;
  LATSCH_KERNEL(leave_turning)
  (nodes_,
   omega.data(),
   {at.row(kX), at.row(kY), at.row(kZ), at.row(kTorsion)},
   {row(kX), row(kY), row(kZ), row(kTorsion)});
  close();
}

void RimRows::count_from(const std::vector<double>& y) {
  for (int k = 0; k < nodes_; ++k) row(kY)[k] -= y[static_cast<std::size_t>(k)];
  close();
}

void RimRows::place_knots(const RimRows& nodes) {
  for (int i = 0; i < kRows; ++i) LATSCH_KERNEL(mean_of_three)(nodes_, nodes.row(i), row(i));
  close();
}

void RimRows::add_from_knots(RimRows& knots) {
  knots.close();
  for (int i = 0; i < kRows; ++i) LATSCH_KERNEL(add_mean_of_three)(nodes_, knots.row(i), row(i));
}

void RimRows::turn_back(const RimFrame& rim, NodeValues& force) const {
  const Eigen::Matrix3d axes = rim.axes();
  LATSCH_KERNEL(turn_to_inertial)
  (nodes_, {row(kX), row(kY), row(kZ), row(kTorsion)}, axes.data(), force.data());
}

}  // namespace latsch::ring_tire
