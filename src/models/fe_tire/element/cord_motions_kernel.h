// SPDX-License-Identifier: Apache-2.0
// Derivatives of the strains and forces of cords (hex8_cords.h) with respect to time, along a
// motion of the nodes. A strain is a quadratic form of positions: the matrix W of a point times the
// Gram matrix of two motions.
//
// This file is included once per kernel set, by hex8_kernels.h only.
#if defined(LATSCH_FE_TIRE_CORD_MOTIONS) == defined(LATSCH_KERNEL_TOGGLE)
#ifdef LATSCH_FE_TIRE_CORD_MOTIONS
#undef LATSCH_FE_TIRE_CORD_MOTIONS
#else
#define LATSCH_FE_TIRE_CORD_MOTIONS
#endif

#include "models/fe_tire/element/hex8_full_integration_kernel.h"

namespace latsch::fe_tire::LATSCH_KERNELS {

/// Computes the Gram matrix G of two motions a and b: sum W_mn a_m . b_n at any point of a layer
/// equals W : G.
LATSCH_INLINE void gram(const V (*a)[3], const V (*b)[3], V* G) {
  for (int m = 0; m < 3; ++m) G[m] = dot(a[m], b[m]);
  G[3] = dot(a[0], b[1]) + dot(a[1], b[0]);
  G[4] = dot(a[1], b[2]) + dot(a[2], b[1]);
  G[5] = dot(a[0], b[2]) + dot(a[2], b[0]);
}
LATSCH_INLINE V times_gram(const CordSheet::Point& point, const V* G) {
  const auto& W = point.W;
  return (W[0][1] * G[3] + (W[1][2] * G[4] + W[0][2] * G[5])) +
         (W[0][0] * G[0] + (W[1][1] * G[1] + W[2][2] * G[2]));
}
LATSCH_INLINE void vectors_of(const V (*x)[3], double zeta, V (*y)[3]) {
  for (int m = 0; m < 3; ++m) {
    for (int i = 0; i < 3; ++i) y[m][i] = zeta * x[kThrough[m]][i] + x[kInPlane[m]][i];
  }
}
/// Returns the second derivative d2S/de2 of the law in cord_law.h.
LATSCH_INLINE V bend_of(const CordLayer& layer, const V& e) {
  constexpr double w = kCordTransition;
  const V square = e * e + w * w;
  return (0.5 * w * w * (layer.E_tension - layer.E_compression)) / (square * sqrt(square));
}

/// Adds the second derivative of the cords' forces along a motion. The strains e1 and e2 include
/// the contribution of alpha.
void add_second_forces(
    const Cords& cords, const Kinematics& m, const V (*e1)[4], const V (*e2)[4], ModalSums& sums) {
  for (int l = 0; l < cords.count(); ++l) {
    const CordSheet& law = cords.laws[l];
    const Cords::Sheet& sheet = cords.sheets[l];
    V y[3][3], f[3][3];
    vectors_of(m.x, law.zeta, y);
    for (V& v : std::span(&f[0][0], 9)) v = 0.0;
    for (int q = 0; q < 4; ++q) {
      const CordSheet::Point& point = law.points[q];
      const V& e = sheet.points[q].e;
      const V S1 = (2.0 * point.dV) * (sheet.points[q].tangent * e1[l][q]);
      const V S2 = point.dV * (bend_of(law.layer, e) * (e1[l][q] * e1[l][q]) +
                               sheet.points[q].tangent * e2[l][q]);
      V b[3][3], db[3][3];
      strain_operator(point, sheet.y, b);
      strain_operator(point, y, db);
      for (int n = 0; n < 3; ++n) {
        for (int i = 0; i < 3; ++i) f[n][i] += S2 * b[n][i] + S1 * db[n][i];
      }
    }
    for (int n = 0; n < 3; ++n) {
      for (int i = 0; i < 3; ++i) {
        sums.f[i][kInPlane[n]] += f[n][i];
        sums.f[i][kThrough[n]] += law.zeta * f[n][i];
      }
    }
  }
}

}  // namespace latsch::fe_tire::LATSCH_KERNELS
#endif
