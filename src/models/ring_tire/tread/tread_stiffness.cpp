// SPDX-License-Identifier: Apache-2.0
// Stiffness of the tread blocks: sums over the lines at a station, then to its four nodes.
//
// With K of one block, (10) gives dT = dp - H t dν_n - y t dν_a + (H a - y n) dψ, and
//   dp = Σ w_m dx_m,  dν_n = Σ d_m n . dx_m/|x'|,  dν_a = Σ d_m a . dx_m/|x'|,  dψ = Σ w_m dψ_m
// so a pair of nodes m, m' gets w w' M_ww + w d' M_wd + d w' M_wd^T + d d' M_dd. H is taken the
// same on all lines here: the crown's curvature of millimeters matters to forces, not to their
// slopes. Where a segment has many stations, some neighbors count as one for the same reason.
#include "models/ring_tire/tread/block_forces.h"
#include "models/ring_tire/tread/tread_contact.h"

namespace latsch::ring_tire {

struct StationStiffness {
  Eigen::Matrix4d ww = Eigen::Matrix4d::Zero(), wd = Eigen::Matrix4d::Zero(),
                  dd = Eigen::Matrix4d::Zero();
};

}  // namespace latsch::ring_tire

#define LATSCH_KERNELS_IN "models/ring_tire/tread/stiffness_kernels.h"
#include "numerics/kernels/for_each_kernel_set.h"

namespace latsch::ring_tire {
namespace {

using Eigen::Matrix3d;
using Eigen::Matrix4d;
using Eigen::Vector3d;

Matrix3d symmetric(const double* of) {
  Matrix3d K;
  K << of[0], of[1], of[2], of[1], of[3], of[4], of[2], of[4], of[5];
  return K;
}

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

}  // namespace

void TreadContact::add_stiffness(double scale, CyclicBand& K) {
  const double rate = 1.0 + (rule_.statics() ? 0.0 : damping_time_ * rule_.velocity);
  const double normal = scale * normal_ * rate, tangential = scale * tangential_ * rate;
  for (std::size_t i = 0; i < patches_.size(); ++i) {
    const Patch& patch = patches_[i];
    const BlockSpan span{stride_, patch.begin, patch.end};
    if (patch.level)
      level_stiffness(span, lines(), results(i), normal, tangential, at_stations(0));
    else
      uneven_stiffness(span, lines(), ground(i), results(i), normal, tangential, at_stations(0));
    Matrix4d pairs[16];
    for (Matrix4d& pair : pairs) pair.setZero();
    for (int j = patch.begin; j < patch.end; j += stations_per_sum_) add_stations(i, j, pairs);
    for (int m = 0; m < 4; ++m)
      for (int o = m; o < 4; ++o) K.block(node(patch.segment, m), o - m) += pairs[4 * m + o];
  }
}

/// Stations [first, first + stations_per_sum_) as one: their sums at their mean place, weighted by
/// stiffness.
void TreadContact::add_stations(std::size_t patch, int first, Matrix4d* pairs) {
  constexpr int kMeans = 15;  // w, d, t, n, length
  double sums[kStationColumns] = {}, mean[kMeans] = {}, weight = 0.0;
  for (int j = first; j < first + stations_per_sum_; ++j) {
    const auto K = [&](int c) { return at_stations(c)[j]; };
    const double trace = K(0) + K(3) + K(5);
    if (trace == 0.0) continue;
    weight += trace;
    for (int c = 0; c < kStationColumns; ++c) sums[c] += K(c);
    for (int c = 0; c < 8; ++c)
      mean[c] += trace * weights_[static_cast<std::size_t>(c * stride_ + j)];
    for (int c = 0; c < kFrameColumns; ++c) mean[8 + c] += trace * frame(patch, c)[j];
  }
  if (weight == 0.0) return;
  for (double& value : mean) value /= weight;
  LATSCH_KERNEL(add_pairs)
  (station_stiffness(symmetric(sums),
                     symmetric(sums + 6),
                     symmetric(sums + 12),
                     height_,
                     Vector3d(mean[8], mean[9], mean[10]),
                     Vector3d(mean[11], mean[12], mean[13]),
                     a_,
                     mean[14]),
   mean,
   mean + 4,
   pairs);
}

}  // namespace latsch::ring_tire
