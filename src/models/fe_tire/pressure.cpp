// SPDX-License-Identifier: Apache-2.0
// Follower pressure on a bilinear face, 2x2 Gauss points: n dA = (x_xi cross x_eta) dxi deta.
// The gas has the potential -p V; over a closed boundary, or one held at its rim, the load
// stiffness is therefore symmetric, and its symmetric part a face is all of it. [Schweizerhof &
// Ramm 1984, Computers & Structures 18] An edge that neither closes nor is held would leave the
// volume, and so the load, undefined: a seal closes it.
#include "models/fe_tire/pressure.h"

#include <Eigen/Geometry>
#include <cmath>

namespace latsch::fe_tire {
namespace {

constexpr double kXi[4] = {-1.0, 1.0, 1.0, -1.0};
constexpr double kEta[4] = {-1.0, -1.0, 1.0, 1.0};

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0.0, -v[2], v[1], v[2], 0.0, -v[0], -v[1], v[0], 0.0;
  return m;
}

}  // namespace

void add_pressure(const Matrix34& x, double p, Vector12& f, Matrix12* K) {
  const double g = 1.0 / std::sqrt(3.0);
  for (int q = 0; q < 4; ++q) {
    Eigen::Vector4d N, N_xi, N_eta;
    for (int a = 0; a < 4; ++a) {
      const double s = 1.0 + g * kXi[q] * kXi[a], t = 1.0 + g * kEta[q] * kEta[a];
      N[a] = 0.25 * s * t;
      N_xi[a] = 0.25 * kXi[a] * t;
      N_eta[a] = 0.25 * s * kEta[a];
    }
    const Eigen::Vector3d x_xi = x * N_xi, x_eta = x * N_eta;
    const Eigen::Vector3d n = x_xi.cross(x_eta);
    for (int a = 0; a < 4; ++a) f.segment<3>(3 * a) -= p * N[a] * n;
    if (K == nullptr) continue;
    const Eigen::Matrix3d c_xi = cross_matrix(x_xi), c_eta = cross_matrix(x_eta);
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b < 4; ++b) {
        // dn/dx_b = N_b,eta [x_xi]x - N_b,xi [x_eta]x;  a cross matrix is its own negative
        // transpose
        const double s = -0.5 * p * (N[a] * N_eta[b] - N[b] * N_eta[a]);
        const double t = -0.5 * p * (N[a] * N_xi[b] - N[b] * N_xi[a]);
        K->block<3, 3>(3 * a, 3 * b) += s * c_xi - t * c_eta;
      }
    }
  }
}

void add_sealed_edge(
    const Matrix34& X, const Matrix34& x, int k, double p, Vector12& f, Matrix12* K) {
  const int a = k, b = (k + 1) % 4;
  Matrix34 strip;  // passes the edge the other way round than the face does
  strip << x.col(b), x.col(a), X.col(a), X.col(b);
  Vector12 f_strip = Vector12::Zero();
  Matrix12 K_strip = Matrix12::Zero();
  add_pressure(strip, p, f_strip, K ? &K_strip : nullptr);
  const int moving[2] = {b, a};
  for (int i = 0; i < 2; ++i) {
    f.segment<3>(3 * moving[i]) += f_strip.segment<3>(3 * i);
    if (K == nullptr) continue;
    for (int j = 0; j < 2; ++j) {
      K->block<3, 3>(3 * moving[i], 3 * moving[j]) += K_strip.block<3, 3>(3 * i, 3 * j);
    }
  }
}

}  // namespace latsch::fe_tire
