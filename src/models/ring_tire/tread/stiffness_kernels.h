// SPDX-License-Identifier: Apache-2.0
// Effect of a station's stiffness on the four nodes of its segment (tread_stiffness.cpp).
#include "models/ring_tire/tread/block_lanes.h"

namespace latsch::ring_tire::LATSCH_KERNELS {

struct SymmetricLanes {
  Lanes xx, xy, xz, yy, yz, zz;

  LATSCH_INLINE Lanes3 operator*(const Lanes3& v) const {
    return {xx * v.x + xy * v.y + xz * v.z,
            xy * v.x + yy * v.y + yz * v.z,
            xz * v.x + yz * v.y + zz * v.z};
  }
};

LATSCH_INLINE SymmetricLanes symmetric_lanes(const double* columns, int stride, int j) {
  const auto at = [&](int c) { return lanes(columns + c * stride + j); };
  return {at(0), at(1), at(2), at(3), at(4), at(5)};
}

/// Returns the vector in rotated axes, whose unit vectors are stored one after the other.
LATSCH_INLINE Lanes3 in_axes(const Lanes3& v, const double* axes) {
  return {v.x * axes[0] + v.y * axes[1] + v.z * axes[2],
          v.x * axes[3] + v.y * axes[4] + v.z * axes[5],
          v.x * axes[6] + v.y * axes[7] + v.z * axes[8]};
}
LATSCH_INLINE SymmetricLanes matrix_in_axes(const SymmetricLanes& K, const double* axes) {
  const Lanes3 x = in_axes({K.xx, K.xy, K.xz}, axes), y = in_axes({K.xy, K.yy, K.yz}, axes),
               z = in_axes({K.xz, K.yz, K.zz}, axes);
  const Lanes3 first = in_axes({x.x, y.x, z.x}, axes), second = in_axes({x.y, y.y, z.y}, axes),
               third = in_axes({x.z, y.z, z.z}, axes);
  return {first.x, first.y, first.z, second.y, second.z, third.z};
}

LATSCH_INLINE Lanes3 scaled(const Lanes& s, const Lanes3& v) { return {s * v.x, s * v.y, s * v.z}; }
LATSCH_INLINE Lanes3 less(const Lanes3& a, const Lanes3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

/// One entry of one matrix for eight stations.
struct StationEntry {
  StationStiffness* of;
  LATSCH_INLINE void put(Eigen::Matrix4d StationStiffness::*matrix,
                         int row,
                         int column,
                         const Lanes& value) const {
    double each[8];
    store(value, each);
    for (int i = 0; i < 8; ++i) (of[i].*matrix).data()[4 * column + row] = each[i];
  }
};

/// Computes the stiffness of the stations of a span in rotated axes, from the sums K, y K and y² K
/// of their blocks in 18 columns and their t, n, |x'| in seven.
void find_station_stiffness(const BlockSpan& at,
                            const double* sums,
                            const double* frame,
                            const double* axis,
                            const double* axes,
                            double height,
                            StationStiffness* stations) {
  for (int j = at.begin; j < at.end; j += kWide) {
    const auto matrix = [&](int c) {
      return matrix_in_axes(symmetric_lanes(sums + c * at.stride, at.stride, j), axes);
    };
    const SymmetricLanes K = matrix(0), Ky = matrix(6), Kyy = matrix(12);
    const Lanes3 t = in_axes(lanes3(frame, at.stride, j), axes),
                 n = in_axes(lanes3(frame + 3 * at.stride, at.stride, j), axes),
                 a = in_axes({axis[0], axis[1], axis[2]}, axes);
    const Lanes over = 1.0 / lanes(frame + 6 * at.stride + j), H = height;
    // Columns of sum K D: derivatives of the summed force, and of y times it, by p, ν_n, ν_a and ψ.
    const Lanes3 by_n = scaled(-H, K * t), by_a = scaled(-1.0, Ky * t);
    const Lanes3 by_psi = less(scaled(H, K * a), Ky * n);
    const Lanes3 y_by_a = scaled(-1.0, Kyy * t), y_by_psi = less(scaled(H, Ky * a), Kyy * n);
    const Lanes nn = -(H * dot(t, by_n)), na = -(H * dot(t, by_a)), aa = -dot(t, y_by_a);
    const Lanes n_psi = -(H * dot(t, by_psi)), a_psi = -dot(t, y_by_psi);
    const Lanes psi_psi = H * dot(a, by_psi) - dot(n, y_by_psi);
    const Lanes3 en3 = scaled(over, n), ea3 = scaled(over, a);
    const StationEntry to{stations + j};
    const Lanes k[3][3] = {{K.xx, K.xy, K.xz}, {K.xy, K.yy, K.yz}, {K.xz, K.yz, K.zz}};
    const Lanes en[3] = {en3.x, en3.y, en3.z}, ea[3] = {ea3.x, ea3.y, ea3.z};
    const Lanes bn[3] = {by_n.x, by_n.y, by_n.z}, ba[3] = {by_a.x, by_a.y, by_a.z},
                bp[3] = {by_psi.x, by_psi.y, by_psi.z};
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) {
        const Lanes wd = bn[r] * en[c] + ba[r] * ea[c];
        to.put(&StationStiffness::ww, r, c, k[r][c]);
        to.put(&StationStiffness::wd, r, c, wd);
        to.put(&StationStiffness::dw, c, r, wd);
        to.put(&StationStiffness::dd,
               r,
               c,
               nn * en[r] * en[c] + aa * ea[r] * ea[c] + na * (en[r] * ea[c] + ea[r] * en[c]));
      }
      const Lanes psi = n_psi * en[r] + a_psi * ea[r];
      to.put(&StationStiffness::ww, r, 3, bp[r]);
      to.put(&StationStiffness::ww, 3, r, bp[r]);
      to.put(&StationStiffness::wd, 3, r, psi);
      to.put(&StationStiffness::dw, r, 3, psi);
    }
    to.put(&StationStiffness::ww, 3, 3, psi_psi);
  }
}

/// Sums over the stations [begin, end) for the ten pairs of nodes m <= m'. `weights` holds w w', w
/// d', d w', d d' of each pair, forty for each station. Half of all pairs at a time stays in
/// registers.
void sum_pairs(const StationStiffness* stations,
               int begin,
               int end,
               const double* weights,
               Eigen::Matrix4d* pairs) {
  for (int half = 0; half < 16; half += 8) {
    Lanes sums[10] = {};
    for (int j = begin; j < end; ++j) {
      const StationStiffness& M = stations[j];
      if (M.ww(0, 0) + M.ww(1, 1) + M.ww(2, 2) == 0.0) continue;  // no block of the station touches
      const Lanes ww = lanes(M.ww.data() + half), wd = lanes(M.wd.data() + half),
                  dw = lanes(M.dw.data() + half), dd = lanes(M.dd.data() + half);
      const double* of = weights + 40 * j;
      for (int pair = 0; pair < 10; ++pair, of += 4)
        sums[pair] += ww * of[0] + wd * of[1] + dw * of[2] + dd * of[3];
    }
    for (int pair = 0; pair < 10; ++pair) store(sums[pair], pairs[pair].data() + half);
  }
}

}  // namespace latsch::ring_tire::LATSCH_KERNELS
