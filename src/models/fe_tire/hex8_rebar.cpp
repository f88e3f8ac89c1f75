// SPDX-License-Identifier: Apache-2.0
// Rebar layers: a membrane at zeta = const that carries stress along its cords only, 2x2 Gauss
// points,
//   W = t int w(e) dA,   f_a = t sum dA S c_a l,   K_ab = t sum dA c_a c_b (S' l l^T + S 1)
// The cord's angle counts from the xi line toward +eta in the tangent plane of the layer. The
// stretch is the full one. The rubber the cords displace is not subtracted (its modulus is 1e-3 of
// theirs). No bending, no slip.
#include "models/fe_tire/hex8_rebar.h"

#include <Eigen/Geometry>
#include <cmath>

#include "models/fe_tire/cord_law.h"

namespace latsch::fe_tire {

RebarPoint rebar_point(const Matrix38& X, double zeta, double angle, int point) {
  const double xi = kGauss * kXi[point], eta = kGauss * kEta[point];
  const Matrix38 parent = parent_gradients(xi, eta, zeta);
  const Eigen::Vector3d G1 = X * parent.row(0).transpose(), G2 = X * parent.row(1).transpose();
  const double length = G1.norm();
  const double along = G1.dot(G2) / length;  // component of G2 along xi
  const double dA = G1.cross(G2).norm();
  const double across = dA / length;
  const double a2 = std::sin(angle) / across;
  const double a1 = (std::cos(angle) - a2 * along) / length;
  return {.N = shape_functions(xi, eta, zeta),
          .c = a1 * parent.row(0).transpose() + a2 * parent.row(1).transpose(),
          .dA = dA};
}

void add_rebars(const Matrix38& X,
                const Materials& materials,
                const Element& element,
                const Matrix38& u,
                Vector24& f,
                Matrix24* K) {
  const Matrix38 x = X + u;
  for (const RebarPlacement& rebar : element.rebars) {
    const CordLayer& layer = materials.layers[rebar.layer];
    for (int q = 0; q < 4; ++q) {
      const RebarPoint point = rebar_point(X, rebar.zeta, layer.angle, q);
      const Eigen::Vector3d l = x * point.c;
      const CordStress cord = stress(layer, 0.5 * (l.squaredNorm() - 1.0));
      const double dV = layer.thickness * point.dA;
      for (int a = 0; a < 8; ++a) f.segment<3>(3 * a) += dV * cord.S * point.c[a] * l;
      if (K == nullptr) continue;
      Eigen::Matrix3d k = dV * cord.tangent * l * l.transpose();
      k.diagonal().array() += dV * cord.S;
      for (int a = 0; a < 8; ++a) {
        for (int b = 0; b < 8; ++b) K->block<3, 3>(3 * a, 3 * b) += point.c[a] * point.c[b] * k;
      }
    }
  }
}

}  // namespace latsch::fe_tire
