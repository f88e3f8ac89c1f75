// SPDX-License-Identifier: Apache-2.0
// Between columns of nodes and rows in the rim's axes (rim_rows.h).
#include "numerics/kernels/kernel_loops.h"

namespace latsch::ring_tire::LATSCH_KERNELS {

using namespace latsch::LATSCH_KERNELS;

/// rows = R^T (columns - origin); `axes`: X, a, Z one after the other.
void turn_to_rim(
    int nodes, const double* columns, const double* origin, const double* axes, const Rows& rows) {
  for (int k = 0; k < nodes; ++k) {
    const double* q = columns + 4 * k;
    const Lane dx = q[0] - origin[0], dy = q[1] - origin[1], dz = q[2] - origin[2];
    Lane(axes[0] * dx + axes[1] * dy + axes[2] * dz).save(rows.x + k);
    Lane(axes[3] * dx + axes[4] * dy + axes[5] * dz).save(rows.y + k);
    Lane(axes[6] * dx + axes[7] * dy + axes[8] * dz).save(rows.z + k);
    rows.torsion[k] = q[3];
  }
}

void turn_to_inertial(int nodes, const ConstRows& rows, const double* axes, double* columns) {
  const Lanes4 X = four(axes[0], axes[1], axes[2], 0.0), a = four(axes[3], axes[4], axes[5], 0.0),
               Z = four(axes[6], axes[7], axes[8], 0.0), torsion = four(0.0, 0.0, 0.0, 1.0);
  for (int k = 0; k < nodes; ++k)
    store(X * rows.x[k] + a * rows.y[k] + (Z * rows.z[k] + torsion * rows.torsion[k]),
          columns + 4 * k);
}

/// (26) at the knot k of a row; T: Lanes for eight at a time, Lane for one.
template <class T>
LATSCH_INLINE T knots(const double* row, int k) {
  return (4.0 / 6.0) * T::load(row + k) +
         (1.0 / 6.0) * (T::load(row + k - 1) + T::load(row + k + 1));
}
void mean_of_three(int nodes, const double* row, double* to) {
  around(nodes, [&](auto type, int k) { knots<decltype(type)>(row, k).save(to + k); });
}
void add_mean_of_three(int nodes, const double* row, double* to) {
  around(nodes, [&](auto type, int k) {
    using T = decltype(type);
    T(T::load(to + k) + knots<T>(row, k)).save(to + k);
  });
}

}  // namespace latsch::ring_tire::LATSCH_KERNELS
