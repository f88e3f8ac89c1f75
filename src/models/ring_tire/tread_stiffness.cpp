// SPDX-License-Identifier: Apache-2.0
// Stiffness of the tread blocks: sums over the lines at a station, then to its four nodes.
//
// With K of one block, (10) gives dT = dp - H t dν_n - y t dν_a + (H a - y n) dψ, and
//   dp = Σ w_m dx_m,  dν_n = Σ d_m n . dx_m/|x'|,  dν_a = Σ d_m a . dx_m/|x'|,  dψ = Σ w_m dψ_m
// so a pair of nodes m, m' gets w w' M_ww + w d' M_wd + d w' M_wd^T + d d' M_dd. H is taken the
// same on all lines here: the crown's curvature of millimeters matters to forces, not to their
// slopes.
#include <algorithm>

#include "models/ring_tire/block_forces.h"
#include "models/ring_tire/tread_contact.h"
#include "numerics/lanes.h"

namespace latsch::ring_tire {
namespace {

using Eigen::Matrix3d;
using Eigen::Matrix4d;
using Eigen::Vector3d;

Matrix3d symmetric(const double* sums, int stride, int j) {
  Matrix3d K;
  const auto at = [&](int c) { return sums[c * stride + j]; };
  K << at(0), at(1), at(2), at(1), at(3), at(4), at(2), at(4), at(5);
  return K;
}

struct StationStiffness {
  Matrix4d ww = Matrix4d::Zero(), wd = Matrix4d::Zero(), dd = Matrix4d::Zero();
};

StationStiffness station_stiffness(const Matrix3d& K,
                                   const Matrix3d& Ky,
                                   const Matrix3d& Kyy,
                                   double H,
                                   const Vector3d& t,
                                   const Vector3d& n,
                                   const Vector3d& a,
                                   double length) {
  StationStiffness M;
  // Columns of sum K D: how the summed force, and y times it, follow p, ν_n, ν_a and ψ.
  const Vector3d by_n = -H * K * t, by_a = -(Ky * t), by_psi = H * K * a - Ky * n;
  const Vector3d y_by_a = -(Kyy * t), y_by_psi = H * Ky * a - Kyy * n;
  const double nn = -H * t.dot(by_n), na = -H * t.dot(by_a), aa = -t.dot(y_by_a);
  const double n_psi = -H * t.dot(by_psi), a_psi = -t.dot(y_by_psi);
  const double psi_psi = H * a.dot(by_psi) - n.dot(y_by_psi);
  const Vector3d en = n / length, ea = a / length;
  M.ww.topLeftCorner<3, 3>() = K;
  M.ww.block<3, 1>(0, 3) = by_psi;
  M.ww.block<1, 3>(3, 0) = by_psi.transpose();
  M.ww(3, 3) = psi_psi;
  M.wd.topLeftCorner<3, 3>() = by_n * en.transpose() + by_a * ea.transpose();
  M.wd.block<1, 3>(3, 0) = (n_psi * en + a_psi * ea).transpose();
  M.dd.topLeftCorner<3, 3>() = nn * en * en.transpose() + aa * ea * ea.transpose() +
                               na * (en * ea.transpose() + ea * en.transpose());
  return M;
}

/// B += x X + y Y + z Z + u U.
LATSCH_INLINE void add_scaled(double* B,
                              const double* X,
                              double x,
                              const double* Y,
                              double y,
                              const double* Z,
                              double z,
                              const double* U,
                              double u) {
  for (int c = 0; c < 16; c += 4)
    store(lanes4(B + c) + lanes4(X + c) * x + lanes4(Y + c) * y + lanes4(Z + c) * z +
              lanes4(U + c) * u,
          B + c);
}

/// The ten pairs of the four nodes, pair (m, m') at 4 m + m'.
LATSCH_CLONES void add_pairs(const StationStiffness& M,
                             const double* w,
                             const double* d,
                             Matrix4d* pairs) {
  const Matrix4d dw = M.wd.transpose();
  for (int m = 0; m < 4; ++m)
    for (int o = m; o < 4; ++o)
      add_scaled(pairs[4 * m + o].data(),
                 M.ww.data(),
                 w[m] * w[o],
                 M.wd.data(),
                 w[m] * d[o],
                 dw.data(),
                 d[m] * w[o],
                 M.dd.data(),
                 d[m] * d[o]);
}

}  // namespace

void TreadContact::add_stiffness(double scale, CyclicBand& K) {
  const double rate = 1.0 + (rule_.statics() ? 0.0 : damping_time_ * rule_.velocity);
  const double normal = scale * normal_ * rate, tangential = scale * tangential_ * rate;
  double* sums = at_stations(0);  // the columns of (10) have done their work
  for (std::size_t i = 0; i < rows_.size();) {
    const int segment = rows_[i].segment;
    std::fill(sums, sums + 18 * blocks_, 0.0);
    int begin = blocks_, end = 0;
    for (; i < rows_.size() && rows_[i].segment == segment; ++i) {
      const Row& row = rows_[i];
      begin = std::min(begin, row.begin);
      end = std::max(end, row.end);
      add_row_stiffness(block_columns(),
                        sums,
                        blocks_,
                        row.begin,
                        row.end,
                        row.offset,
                        line_y_[static_cast<std::size_t>(row.line)],
                        normal,
                        tangential);
    }
    Matrix4d pairs[16];
    for (Matrix4d& pair : pairs) pair.setZero();
    for (int j = begin; j < end; ++j) {
      double w[4], d[4];
      for (int m = 0; m < 4; ++m) {
        w[m] = weight(m)[j];
        d[m] = slope_weight(m)[j];
      }
      add_pairs(station_stiffness(symmetric(sums, blocks_, j),
                                  symmetric(sums + 6 * blocks_, blocks_, j),
                                  symmetric(sums + 12 * blocks_, blocks_, j),
                                  height_,
                                  frame_vector(segment, kT, j),
                                  frame_vector(segment, kN, j),
                                  a_,
                                  frame(segment, kLength)[j]),
                w,
                d,
                pairs);
    }
    for (int m = 0; m < 4; ++m)
      for (int o = m; o < 4; ++o) K.block(node(segment, m), o - m) += pairs[4 * m + o];
  }
}

}  // namespace latsch::ring_tire
