// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/rim_rows.h"

#include "numerics/lanes.h"

namespace latsch::ring_tire {
namespace {

struct Rows {
  double *x, *y, *z, *torsion;
};

/// rows = R^T (columns - origin); `axes`: X, a, Z one after the other.
LATSCH_CLONES void turn_to_rim(
    int nodes, const double* columns, const double* origin, const double* axes, const Rows& rows) {
#pragma GCC ivdep
  for (int k = 0; k < nodes; ++k) {
    const double* q = columns + 4 * k;
    const double dx = q[0] - origin[0], dy = q[1] - origin[1], dz = q[2] - origin[2];
    rows.x[k] = axes[0] * dx + axes[1] * dy + axes[2] * dz;
    rows.y[k] = axes[3] * dx + axes[4] * dy + axes[5] * dz;
    rows.z[k] = axes[6] * dx + axes[7] * dy + axes[8] * dz;
    rows.torsion[k] = q[3];
  }
}

LATSCH_CLONES void add_turned_back(int nodes,
                                   const Rows& rows,
                                   const double* axes,
                                   double* columns) {
#pragma GCC ivdep
  for (int k = 0; k < nodes; ++k) {
    double* f = columns + 4 * k;
    const double x = rows.x[k], y = rows.y[k], z = rows.z[k];
    f[0] += axes[0] * x + axes[3] * y + axes[6] * z;
    f[1] += axes[1] * x + axes[4] * y + axes[7] * z;
    f[2] += axes[2] * x + axes[5] * y + axes[8] * z;
    f[3] += rows.torsion[k];
  }
}

/// Columns X, a, Z.
Eigen::Matrix3d axes_of(const RimFrame& rim) {
  Eigen::Matrix3d axes;
  axes << rim.X, rim.a, rim.Z;
  return axes;
}

}  // namespace

RimRows::RimRows(int nodes, int more)
    : nodes_(nodes), memory_(static_cast<std::size_t>((kRows + more) * (nodes + 2 * kBeyond))) {}

void RimRows::place(const NodeValues& q, const RimFrame& rim) {
  const Eigen::Matrix3d axes = axes_of(rim);
  turn_to_rim(
      nodes_, q.data(), rim.center.data(), axes.data(), {row(kX), row(kY), row(kZ), row(kTorsion)});
  for (int i = 0; i < kRows; ++i)
    for (int k = 0; k < kBeyond; ++k) {
      row(i)[-1 - k] = row(i)[nodes_ - 1 - k];
      row(i)[nodes_ + k] = row(i)[k];
    }
}

void RimRows::place_rates(RimRows& at, const NodeValues& v, const RimFrame& rim) {
  const Eigen::Matrix3d axes = axes_of(rim);
  turn_to_rim(nodes_,
              v.data(),
              rim.velocity.data(),
              axes.data(),
              {row(kX), row(kY), row(kZ), row(kTorsion)});
  const Eigen::Vector3d omega = axes.transpose() * rim.angular_velocity;
  for (int k = 0; k < nodes_; ++k) {
    const double x = at.row(kX)[k], y = at.row(kY)[k], z = at.row(kZ)[k];
    row(kX)[k] -= omega.y() * z - omega.z() * y;
    row(kY)[k] -= omega.z() * x - omega.x() * z;
    row(kZ)[k] -= omega.x() * y - omega.y() * x;
  }
}

void RimRows::add_to(NodeValues& force, const RimFrame& rim) {
  const Eigen::Matrix3d axes = axes_of(rim);
  add_turned_back(nodes_, {row(kX), row(kY), row(kZ), row(kTorsion)}, axes.data(), force.data());
}

}  // namespace latsch::ring_tire
