// SPDX-License-Identifier: Apache-2.0
// Derivatives along a motion of the nodes of the solid-shell's generalized strains and of its
// forces. The latter are the forces of hex8_solid_shell_kernel.h, differentiated twice by the
// product rule.
//
// This file is included once per kernel set, by hex8_kernels.h only.
#if defined(LATSCH_FE_TIRE_HEX8_STRAIN_MOTIONS) == defined(LATSCH_KERNEL_TOGGLE)
#ifdef LATSCH_FE_TIRE_HEX8_STRAIN_MOTIONS
#undef LATSCH_FE_TIRE_HEX8_STRAIN_MOTIONS
#else
#define LATSCH_FE_TIRE_HEX8_STRAIN_MOTIONS
#endif

#include "models/fe_tire/element/hex8_full_integration_kernel.h"

namespace latsch::fe_tire::LATSCH_KERNELS {

/// Computes the strains at the points for `count` sets of generalized strains g and enhanced
/// strains alpha. Each entry of P is read once for all sets.
template <int count>
LATSCH_INLINE void to_points(const SolidShellShape& s,
                             const V* const (&g)[count],
                             const V* const (&alpha)[count],
                             V (*const (&E)[count])[6]) {
  for (int q = 0; q < kPoints; ++q) {
    V sum[count][6];
    for (int r = 0; r < 6; ++r) {
      for (int k = 0; k < count; ++k) sum[k][r] = s.P[q][r][0] * g[k][0];
    }
    const auto add = [&](int column, const V* const(&of)[count], int j) {
      for (int r = 0; r < 6; ++r) {
        const V P = s.P[q][r][column + j];
        for (int k = 0; k < count; ++k) sum[k][r] += P * of[k][j];
      }
    };
    for (int j = 1; j < kStrains; ++j) add(0, g, j);
    for (int j = 0; j < kEnhanced; ++j) add(kStrains, alpha, j);
    for (int r = 0; r < 6; ++r) {
      for (int k = 0; k < count; ++k) E[k][q][r] = sum[k][r];
    }
  }
}

/// Applies the transpose of to_points(): adds the contributions of the weighted stresses S at the
/// points to the stresses that belong to the generalized strains (t) and to the enhanced strains
/// (alpha). Several columns are summed in registers at once.
LATSCH_INLINE void from_points(const SolidShellShape& s, const V (*S)[6], V* t, V* alpha) {
  constexpr int kTogether = 9;
  static_assert(kStrains % kTogether == 0);
  const auto add = [&](auto count, int column, V* to) {
    V sum[count];
    for (int j = 0; j < count; ++j) sum[j] = to[j];
    for (int q = 0; q < kPoints; ++q) {
      for (int r = 0; r < 6; ++r) {
        for (int j = 0; j < count; ++j) sum[j] += s.P[q][r][column + j] * S[q][r];
      }
    }
    for (int j = 0; j < count; ++j) to[j] = sum[j];
  };
  for (int j = 0; j < kStrains; j += kTogether)
    add(std::integral_constant<int, kTogether>(), j, t + j);
  add(std::integral_constant<int, kEnhanced>(), kStrains, alpha);
}

/// Computes the first derivatives, along a motion, of the generalized strains and of the components
/// c whose squares they contain.
LATSCH_INLINE void first_strains(
    const SolidShellShape& s, const Kinematics& k, const Kinematics& m, V* c1, V* g) {
  using voigt::kColumn, voigt::kRow;
  for (int r = 0; r < 6; ++r) {
    const V* Fa = k.F[kRow[r]];
    g[r] = r < 3 ? dot(m.F[r], Fa) : dot(m.F[kRow[r]], k.F[kColumn[r]]) + dot(Fa, m.F[kColumn[r]]);
  }
  for (int q = 0; q < kSquareCount; ++q) {
    const auto [z, axis] = kSquares[q];
    c1[q] = dot(m.z[z], k.d[axis]) + dot(k.z[z], m.d[axis]);
    const V square = 2.0 * (k.c[q] * c1[q]);
    for (int r = 0; r < 6; ++r) g[r] += s.w[r][q] * square;
  }
  for (int e = 0; e < 12; ++e) g[6 + e] = 0.0;
  for (const auto& [e, a, b] : kPairs) g[6 + e] += dot(m.x[a], k.x[b]) + dot(k.x[a], m.x[b]);
}

/// Computes second derivatives of the generalized strains along the motion.
LATSCH_INLINE void second_strains(
    const SolidShellShape& s, const Kinematics& k, const Kinematics& m, const V* c1, V* g) {
  using voigt::kColumn, voigt::kRow;
  for (int r = 0; r < 6; ++r) {
    const V C = dot(m.F[kRow[r]], m.F[kColumn[r]]);
    g[r] = r < 3 ? C : V(2.0 * C);
  }
  for (int q = 0; q < kSquareCount; ++q) {
    const V square = 2.0 * (c1[q] * c1[q]) + 4.0 * (k.c[q] * m.c[q]);
    for (int r = 0; r < 6; ++r) g[r] += s.w[r][q] * square;
  }
  for (int e = 0; e < 12; ++e) g[6 + e] = 0.0;
  for (const auto& [e, a, b] : kPairs) g[6 + e] += 2.0 * dot(m.x[a], m.x[b]);
}

/// Adds the second derivative of f = B^T t along the motion. t[0], t[1], t[2] hold t and its first
/// and second derivative.
void add_second_forces(const SolidShellShape& s,
                       const Kinematics& k,
                       const Kinematics& m,
                       const V* c1,
                       const V (*t)[kStrains],
                       ModalSums& sums) {
  V T1[kSquareCount], T2[kSquareCount];
  for (int q = 0; q < kSquareCount; ++q) {
    V tau[3];
    for (int n = 0; n < 3; ++n) {
      tau[n] = s.w[0][q] * t[n][0];
      for (int r = 1; r < 6; ++r) tau[n] += s.w[r][q] * t[n][r];
    }
    T1[q] = 2.0 * (c1[q] * tau[0] + k.c[q] * tau[1]);
    T2[q] = 4.0 * (m.c[q] * tau[0]) + (4.0 * (c1[q] * tau[1]) + 2.0 * (k.c[q] * tau[2]));
  }
  const auto times = [](const V* F, const V* t, V* Ft) {
    Ft[0] = F[0] * t[0] + (F[1] * t[3] + F[2] * t[5]);
    Ft[1] = F[0] * t[3] + (F[1] * t[1] + F[2] * t[4]);
    Ft[2] = F[0] * t[5] + (F[1] * t[4] + F[2] * t[2]);
  };
  for (int i = 0; i < 3; ++i) {
    const V F[3] = {k.F[0][i], k.F[1][i], k.F[2][i]}, dF[3] = {m.F[0][i], m.F[1][i], m.F[2][i]};
    V Ft[3], dFt[3];
    times(F, t[2], Ft);
    times(dF, t[1], dFt);
    V by_z[3] = {V(0.0), V(0.0), V(0.0)}, by_axis[3] = {V(0.0), V(0.0), V(0.0)};
    for (int q = 0; q < kSquareCount; ++q) {
      const auto [z, j] = kSquares[q];
      by_z[z] += T2[q] * k.d[j][i] + 2.0 * (T1[q] * m.d[j][i]);
      by_axis[j] += T2[q] * k.z[z][i] + 2.0 * (T1[q] * m.z[z][i]);
    }
    for (int n = 0; n < kModes; ++n) {
      V sum = sums.f[i][n];
      for (int j = 0; j < 3; ++j) {
        sum += s.b[n][j] * (Ft[j] + 2.0 * dFt[j]);
        sum += s.gamma[n][j] * by_z[j];
        sum += s.along[n][j] * by_axis[j];
      }
      sums.f[i][n] = sum;
    }
    for (const auto& [e, a, b] : kPairs) {
      sums.f[i][a] += t[2][6 + e] * k.x[b][i] + 2.0 * (t[1][6 + e] * m.x[b][i]);
      sums.f[i][b] += t[2][6 + e] * k.x[a][i] + 2.0 * (t[1][6 + e] * m.x[a][i]);
    }
  }
}

}  // namespace latsch::fe_tire::LATSCH_KERNELS
#endif
