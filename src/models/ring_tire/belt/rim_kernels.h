// SPDX-License-Identifier: Apache-2.0
// Conversion between columns of nodes and rows in the rim's axes (rim_rows.h).
#include "numerics/kernels/kernel_loops.h"

namespace latsch::ring_tire::LATSCH_KERNELS {

using namespace latsch::LATSCH_KERNELS;

/// Computes rows = R^T (columns - origin); `axes` holds X, a, Z one after the other.
void turn_to_rim(
    int nodes, const double* columns, const double* origin, const double* axes, const Rows& rows) {
  const auto along = [&](int i, const Lanes4& dx, const Lanes4& dy, const Lanes4& dz) {
    return Lanes4(axes[3 * i] * dx + axes[3 * i + 1] * dy + axes[3 * i + 2] * dz);
  };
  by_four(nodes, [&](int k) {
    const double* q = columns + 4 * k;
    Lanes4 at[4] = {lanes4(q), lanes4(q + 4), lanes4(q + 8), lanes4(q + 12)};
    transpose(at);
    const Lanes4 dx = at[0] - origin[0], dy = at[1] - origin[1], dz = at[2] - origin[2];
    store(along(0, dx, dy, dz), rows.x + k);
    store(along(1, dx, dy, dz), rows.y + k);
    store(along(2, dx, dy, dz), rows.z + k);
    store(at[3], rows.torsion + k);
  });
}

/// Computes rates -= ω × positions.
void leave_turning(int nodes, const double* omega, const ConstRows& at, const Rows& rates) {
  around(nodes, [&](auto type, int k) {
    using T = decltype(type);
    const T x = T::load(at.x + k), y = T::load(at.y + k), z = T::load(at.z + k);
    T(T::load(rates.x + k) - (omega[1] * z - omega[2] * y)).save(rates.x + k);
    T(T::load(rates.y + k) - (omega[2] * x - omega[0] * z)).save(rates.y + k);
    T(T::load(rates.z + k) - (omega[0] * y - omega[1] * x)).save(rates.z + k);
  });
}

void turn_to_inertial(int nodes, const ConstRows& rows, const double* axes, double* columns) {
  const Lanes4 X = four(axes[0], axes[1], axes[2], 0.0), a = four(axes[3], axes[4], axes[5], 0.0),
               Z = four(axes[6], axes[7], axes[8], 0.0), torsion = four(0.0, 0.0, 0.0, 1.0);
  for (int k = 0; k < nodes; ++k)
    store(X * rows.x[k] + a * rows.y[k] + (Z * rows.z[k] + torsion * rows.torsion[k]),
          columns + 4 * k);
}

/// Evaluates (26) at knot k of a row. T is Lanes for eight knots at a time, Lane for one.
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
