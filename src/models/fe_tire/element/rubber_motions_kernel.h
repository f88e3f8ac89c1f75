// SPDX-License-Identifier: Apache-2.0
// Second derivative of the stress of rubber (rubber_law.h) along a strain, computed with power
// series, in the size of the strain, of the minors of C and of the powers of det C.
//
// This file is included once per kernel set, by hex8_kernels.h only.
#if defined(LATSCH_FE_TIRE_RUBBER_MOTIONS) == defined(LATSCH_KERNEL_TOGGLE)
#ifdef LATSCH_FE_TIRE_RUBBER_MOTIONS
#undef LATSCH_FE_TIRE_RUBBER_MOTIONS
#else
#define LATSCH_FE_TIRE_RUBBER_MOTIONS
#endif

#include "models/fe_tire/element/hex8_full_integration_kernel.h"

namespace latsch::fe_tire::LATSCH_KERNELS {

inline constexpr int kPoints = 8;  // number of stress points of an element

/// Computes the minors of a symmetric matrix in Voigt order, and the mixed minors in cof(a + b) =
/// cof a + mixed + cof b.
LATSCH_INLINE void minors(const V* a, V* cof) {
  cof[0] = a[1] * a[2] - a[4] * a[4];
  cof[1] = a[0] * a[2] - a[5] * a[5];
  cof[2] = a[0] * a[1] - a[3] * a[3];
  cof[3] = a[4] * a[5] - a[3] * a[2];
  cof[4] = a[3] * a[5] - a[0] * a[4];
  cof[5] = a[3] * a[4] - a[1] * a[5];
}
LATSCH_INLINE void mixed_minors(const V* a, const V* b, V* cof) {
  cof[0] = (a[1] * b[2] + b[1] * a[2]) - 2.0 * (a[4] * b[4]);
  cof[1] = (a[0] * b[2] + b[0] * a[2]) - 2.0 * (a[5] * b[5]);
  cof[2] = (a[0] * b[1] + b[0] * a[1]) - 2.0 * (a[3] * b[3]);
  cof[3] = (a[4] * b[5] + b[4] * a[5]) - (a[3] * b[2] + b[3] * a[2]);
  cof[4] = (a[3] * b[5] + b[3] * a[5]) - (a[0] * b[4] + b[0] * a[4]);
  cof[5] = (a[3] * b[4] + b[3] * a[4]) - (a[1] * b[5] + b[1] * a[5]);
}
/// Returns the double contraction a : b of symmetric matrices in Voigt order.
LATSCH_INLINE V double_dot(const V* a, const V* b) {
  const V shear = a[3] * b[3] + (a[4] * b[4] + a[5] * b[5]);
  return 2.0 * shear + (a[0] * b[0] + (a[1] * b[1] + a[2] * b[2]));
}

/// Quantities of rubber at a point that do not depend on the direction of the strain increment.
struct RubberPoint {
  V C[6], cof[6], det, inverse, J, I1, I2, a, b;
};

LATSCH_INLINE void prepare(const Hyperelastic& law, const V* E, RubberPoint& p) {
  for (int k = 0; k < 6; ++k) p.C[k] = k < 3 ? 2.0 * E[k] + 1.0 : E[k];
  minors(p.C, p.cof);
  p.det = p.C[0] * p.cof[0] + (p.C[3] * p.cof[3] + p.C[5] * p.cof[5]);
  p.inverse = 1.0 / p.det;
  p.J = sqrt(p.det);
  const V j = inverse_cube_root(p.det);
  p.I1 = p.C[0] + p.C[1] + p.C[2];
  p.I2 = 0.5 * (p.I1 * p.I1 - double_dot(p.C, p.C));
  p.a = 2.0 * law.C10 * j;
  p.b = 2.0 * law.C01 * (j * j);
}

/// Coefficients of e and e^2 in the power series of (1 + a1 e + a2 e^2)^n.
struct Series {
  V first, second;
};
LATSCH_INLINE Series power(double n, const V& a1, const V& a2) {
  return {n * a1, n * a2 + (0.5 * n * (n - 1.0)) * (a1 * a1)};
}

/// Computes the second derivative by e of the stress S (rubber_law.h) at the strain E + e E1.
LATSCH_INLINE void second_stress(const Hyperelastic& law, const RubberPoint& p, const V* E1, V* S) {
  V c[6], cof1[6], cof2[6];
  for (int k = 0; k < 6; ++k) c[k] = k < 3 ? V(2.0 * E1[k]) : E1[k];
  mixed_minors(p.C, c, cof1);
  minors(c, cof2);
  const V a1 = double_dot(p.cof, c) * p.inverse, a2 = double_dot(p.C, cof2) * p.inverse;
  const Series J = power(0.5, a1, a2), j = power(-1.0 / 3.0, a1, a2);
  const Series jj = power(-2.0 / 3.0, a1, a2), v = power(-1.0, a1, a2);
  const V t = c[0] + c[1] + c[2];
  const V i1 = p.I1 * t - double_dot(p.C, c), i2 = 0.5 * (t * t - double_dot(c, c));
  const V p0 = law.K * (p.det - p.J), p1 = law.K * (p.det * a1 - p.J * J.first);
  const V p2 = law.K * (p.det * a2 - p.J * J.second);
  const V a = p.a * (1.0 / 3.0), b = p.b * (2.0 / 3.0);
  const V s0 = p0 - (a * p.I1 + b * p.I2);
  const V s1 = p1 - (a * (j.first * p.I1 + t) + b * (jj.first * p.I2 + i1));
  const V s2 =
      p2 - (a * (j.second * p.I1 + j.first * t) + b * (jj.second * p.I2 + (jj.first * i1 + i2)));
  const V q0 = s0 * p.inverse, q1 = (s1 + s0 * v.first) * p.inverse;
  const V q2 = (s2 + (s1 * v.first + s0 * v.second)) * p.inverse;
  for (int k = 0; k < 6; ++k) {
    const V B0 = k < 3 ? p.I1 - p.C[k] : -p.C[k], B1 = k < 3 ? t - c[k] : -c[k];
    V sum = q0 * cof2[k] + (q1 * cof1[k] + q2 * p.cof[k]);
    sum += p.b * (jj.second * B0 + jj.first * B1);
    if (k < 3) sum += p.a * j.second;
    S[k] = 2.0 * sum;
  }
}

}  // namespace latsch::fe_tire::LATSCH_KERNELS
#endif
