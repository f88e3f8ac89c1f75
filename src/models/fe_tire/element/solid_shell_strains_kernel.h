// SPDX-License-Identifier: Apache-2.0
// Generalized strains of the solid-shell, equations (2) to (4) of hex8_solid_shell_kernel.h: the
// strain E_c of the mean deformation gradient and the twelve coefficients e. Computes them, their
// derivatives by the modal vectors, and the forces and stiffness that their stresses cause.
//
// This file is included once per kernel set, by hex8_solid_shell_kernel.h only.
#if defined(LATSCH_FE_TIRE_SOLID_SHELL_STRAINS) == defined(LATSCH_KERNEL_TOGGLE)
#ifdef LATSCH_FE_TIRE_SOLID_SHELL_STRAINS
#undef LATSCH_FE_TIRE_SOLID_SHELL_STRAINS
#else
#define LATSCH_FE_TIRE_SOLID_SHELL_STRAINS
#endif

#include "models/fe_tire/element/hex8_sums.h"

namespace latsch::fe_tire::LATSCH_KERNELS {

using solid_shell::kPairs;
using solid_shell::kSquares;

inline constexpr int kEnhanced = SolidShellShape::kEnhanced;
inline constexpr int kSquareCount = SolidShellShape::kSquares;
inline constexpr int kStrains = SolidShellShape::kStrains;
inline constexpr int kColumns = SolidShellShape::kColumns;

/// Deformation of the element: columns of the mean gradient F = [f_1 f_2 f_3], hourglass vectors
/// z_m (without z_123) and their components c.
template <class V>
struct KinematicsOf {
  V F[3][3];  // [column][i]
  V x[kModes][3];
  V z[3][3], d[3][3], c[kSquareCount];  // equation (4); d_j = F a_j
};

using Kinematics = KinematicsOf<V>;

/// Operators of the shape in the precision of V.
template <class V>
using Operators = SolidShellOperators<typename V::Constant>;

/// Computes the deformation from the modal vectors. Returns false in lanes in which the mean
/// deformation inverts the element.
LATSCH_INLINE Mask follow(const SolidShellShape& s, Kinematics& k) {
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) {
      V F = s.b[0][j] * k.x[0][i], z = s.gamma[0][j] * k.x[0][i], d = s.along[0][j] * k.x[0][i];
      for (int m = 1; m < kModes; ++m) {
        F += s.b[m][j] * k.x[m][i];
        z += s.gamma[m][j] * k.x[m][i];
        d += s.along[m][j] * k.x[m][i];
      }
      k.F[j][i] = F;
      k.z[j][i] = z;
      k.d[j][i] = d;
    }
  }
  for (int q = 0; q < kSquareCount; ++q) k.c[q] = dot(k.z[kSquares[q].z], k.d[kSquares[q].axis]);
  const auto& F = k.F;
  const V minors[3] = {F[1][1] * F[2][2] - F[1][2] * F[2][1],
                       F[1][2] * F[2][0] - F[1][0] * F[2][2],
                       F[1][0] * F[2][1] - F[1][1] * F[2][0]};
  return dot(F[0], minors) > V(s.volume > 0.0 ? 0.0 : HUGE_VAL);
}

/// Computes the generalized strains (E_c, e), equations (2) and (3).
LATSCH_INLINE void generalized_strains(const SolidShellShape& s, const Kinematics& k, V* g) {
  using voigt::kColumn, voigt::kRow;
  for (int r = 0; r < 6; ++r) {
    const V C = dot(k.F[kRow[r]], k.F[kColumn[r]]);
    g[r] = r < 3 ? 0.5 * (C - 1.0) : C;
  }
  for (int q = 0; q < kSquareCount; ++q) {
    const V square = k.c[q] * k.c[q];
    for (int r = 0; r < 6; ++r) g[r] += s.w[r][q] * square;
  }
  for (int e = 0; e < 12; ++e) g[6 + e] = -s.e0[e];
  for (const auto& [e, m, n] : kPairs) g[6 + e] += dot(k.x[m], k.x[n]);
}

/// Computes the matrix Dc of the derivatives dc = Dc dx, stored as [square][direction][modal
/// vector].
template <class V>
void hourglass_operator(const Operators<V>& s, const KinematicsOf<V>& k, V (*Dc)[3][kModes]) {
  for (int q = 0; q < kSquareCount; ++q) {
    const auto [z, j] = kSquares[q];
    for (int i = 0; i < 3; ++i) {
      for (int m = 0; m < kModes; ++m) {
        Dc[q][i][m] = s.gamma[m][z] * k.d[j][i] + s.along[m][j] * k.z[z][i];
      }
    }
  }
}

/// Computes the matrix B of the derivatives dE_c = B dx. The derivatives de are not stored, because
/// equation (3) is as short.
template <class V>
void strain_operator(const Operators<V>& s,
                     const KinematicsOf<V>& k,
                     const V (*Dc)[3][kModes],
                     V (*B)[3][kModes]) {
  using voigt::kColumn, voigt::kRow;
  for (int i = 0; i < 3; ++i) {
    for (int m = 0; m < kModes; ++m) {
      for (int r = 0; r < 6; ++r) {
        const int a = kRow[r], b = kColumn[r];
        V sum = s.b[m][b] * k.F[a][i];
        if (r >= 3) sum += s.b[m][a] * k.F[b][i];
        B[r][i][m] = sum;
      }
      for (int q = 0; q < kSquareCount; ++q) {
        const V dcc = 2.0 * k.c[q] * Dc[q][i][m];
        for (int r = 0; r < 6; ++r) B[r][i][m] += s.w[r][q] * dcc;
      }
    }
  }
}

/// Adds the forces B^T t of the stresses t to f.
void add_forces(const SolidShellShape& s, const Kinematics& k, const V* t, ModalSums& sums) {
  V T[kSquareCount];
  for (int q = 0; q < kSquareCount; ++q) {
    V sum = s.w[0][q] * t[0];
    for (int r = 1; r < 6; ++r) sum += s.w[r][q] * t[r];
    T[q] = 2.0 * k.c[q] * sum;
  }
  for (int i = 0; i < 3; ++i) {
    const V F[3] = {k.F[0][i], k.F[1][i], k.F[2][i]};
    const V Ft[3] = {F[0] * t[0] + (F[1] * t[3] + F[2] * t[5]),
                     F[0] * t[3] + (F[1] * t[1] + F[2] * t[4]),
                     F[0] * t[5] + (F[1] * t[4] + F[2] * t[2])};
    V by_z[3] = {V(0.0), V(0.0), V(0.0)}, by_axis[3] = {V(0.0), V(0.0), V(0.0)};
    for (int q = 0; q < kSquareCount; ++q) {
      const auto [z, j] = kSquares[q];
      by_z[z] += T[q] * k.d[j][i];
      by_axis[j] += T[q] * k.z[z][i];
    }
    for (int m = 0; m < kModes; ++m) {
      V sum = sums.f[i][m];
      for (int j = 0; j < 3; ++j) {
        sum += s.b[m][j] * Ft[j];
        sum += s.gamma[m][j] * by_z[j];
        sum += s.along[m][j] * by_axis[j];
      }
      sums.f[i][m] = sum;
    }
    for (const auto& [e, m, n] : kPairs) {
      sums.f[i][m] += t[6 + e] * k.x[n][i];
      sums.f[i][n] += t[6 + e] * k.x[m][i];
    }
  }
}

/// Adds the stiffness by the stresses t: the second derivative of the generalized strains times t.
/// The contribution T of the squares, which enters as T Dc^T Dc, is returned in TDc; the remaining
/// part, which is the same in all directions, is added here.
template <class V>
void add_stress_stiffness(const Operators<V>& s,
                          const KinematicsOf<V>& k,
                          const V (*Dc)[3][kModes],
                          const V* t,
                          V (*TDc)[3][kModes],
                          ModalSumsOf<V>& sums) {
  V v[3][kModes], H[kModes][kModes];
  for (V& entry : std::span(&v[0][0], 3 * kModes)) entry = 0.0;
  for (int q = 0; q < kSquareCount; ++q) {
    const auto [z, j] = kSquares[q];
    V T = s.w[0][q] * t[0];
    for (int r = 1; r < 6; ++r) T += s.w[r][q] * t[r];
    T = 2.0 * T;
    const V Tc = T * k.c[q];
    for (int m = 0; m < kModes; ++m) {
      v[j][m] += s.gamma[m][z] * Tc;
      for (int i = 0; i < 3; ++i) TDc[q][i][m] = T * Dc[q][i][m];
    }
  }
  for (int n = 0; n < kModes; ++n) {
    const auto* b = s.b[n];
    const V u[3] = {b[0] * t[0] + (b[1] * t[3] + b[2] * t[5]),
                    b[0] * t[3] + (b[1] * t[1] + b[2] * t[4]),
                    b[0] * t[5] + (b[1] * t[4] + b[2] * t[2])};
    for (int m = 0; m <= n; ++m) {
      V sum = s.b[m][0] * u[0] + (s.b[m][1] * u[1] + s.b[m][2] * u[2]);
      for (int j = 0; j < 3; ++j) {
        sum += s.along[n][j] * v[j][m];
        sum += s.along[m][j] * v[j][n];
      }
      H[m][n] = sum;
    }
  }
  for (const auto& [e, m, n] : kPairs) H[std::min(m, n)][std::max(m, n)] += t[6 + e];
  for (int i = 0; i < 3; ++i) {
    for (int m = 0; m < kModes; ++m) {
      for (int n = m; n < kModes; ++n) sums.K[i][m][n] += H[m][n];
    }
  }
}

}  // namespace latsch::fe_tire::LATSCH_KERNELS
#endif
