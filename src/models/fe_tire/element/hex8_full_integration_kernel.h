// SPDX-License-Identifier: Apache-2.0
// Eight-node displacement element with 2x2x2 Gauss points, total Lagrangian (CalculiX' C3D8):
//   F = x dN^T,  E = (F^T F - 1) / 2
//   f = sum dV dN^T F S
//   K(a i, b j) = sum dV dN_a^T (B_i^T D B_j + S delta_ij) dN_b,  B_i = dE / dF_i
// The element is used for comparison. It locks in shear, in thickness bending and for nearly
// incompressible rubber. [Bathe 1996] Finite Element Procedures, section 6.3.5.
//
// This file is included once per kernel set, by hex8_kernels.h only.
#if defined(LATSCH_FE_TIRE_HEX8_FULL_INTEGRATION) == defined(LATSCH_KERNEL_TOGGLE)
#ifdef LATSCH_FE_TIRE_HEX8_FULL_INTEGRATION
#undef LATSCH_FE_TIRE_HEX8_FULL_INTEGRATION
#else
#define LATSCH_FE_TIRE_HEX8_FULL_INTEGRATION
#endif

#include "models/fe_tire/element/hex8_solid_shell_kernel.h"

namespace latsch::fe_tire::LATSCH_KERNELS {

/// Computes B_i^T v for a vector v in the Voigt order of stresses. F is row i of the deformation
/// gradient.
LATSCH_INLINE void times_strain_operator(const V* F, const V* v, V* product) {
  product[0] = F[0] * v[0] + (F[1] * v[3] + F[2] * v[5]);
  product[1] = F[0] * v[3] + (F[1] * v[1] + F[2] * v[4]);
  product[2] = F[0] * v[5] + (F[1] * v[4] + F[2] * v[2]);
}

/// Computes C[K][L] = B_i^T D B_j.
LATSCH_INLINE void moduli(const V (*D)[6], const V* F_i, const V* F_j, V (*C)[3]) {
  V DB[3][6];
  for (int r = 0; r < 6; ++r) {
    V row[3];
    times_strain_operator(F_j, D[r], row);
    for (int l = 0; l < 3; ++l) DB[l][r] = row[l];
  }
  for (int l = 0; l < 3; ++l) {
    V column[3];
    times_strain_operator(F_i, DB[l], column);
    for (int k = 0; k < 3; ++k) C[k][l] = column[k];
  }
}

LATSCH_INLINE void add_point_stiffness(
    const double (*dN)[8], const V (*F)[3], const V* S, const V (*D)[6], NodalSums& sums) {
  for (int block = 0; block < 6; ++block) {
    const int i = voigt::kRow[block], j = voigt::kColumn[block];
    V C[3][3];
    moduli(D, F[i], F[j], C);
    if (i == j) {
      for (int k = 0; k < 3; ++k) {
        for (int l = 0; l < 3; ++l) C[k][l] += S[voigt::kPlace[k][l]];
      }
    }
    for (int b = 0; b < 8; ++b) {
      V t[3];
      for (int k = 0; k < 3; ++k) {
        t[k] = C[k][0] * dN[0][b] + (C[k][1] * dN[1][b] + C[k][2] * dN[2][b]);
      }
      for (int a = i == j ? b : 0; a < 8; ++a) {
        const int row = 3 * a + i, column = 3 * b + j;
        V& K = sums.K[row >= column ? ElementBatch::entry(row, column)
                                    : ElementBatch::entry(column, row)];
        K = dN[0][a] * t[0] + (dN[1][a] * t[1] + (dN[2][a] * t[2] + K));
      }
    }
  }
}

/// Adds the forces and the stiffness of an element with nodes at x[3 a + i] to the sums. In lanes
/// that fail, the sums are undefined.
Mask add_full_integration(const ElementLaw& law,
                          bool stiffness,
                          const V* x,
                          NodalSums& sums,
                          const DeadStresses& dead = {}) {
  using voigt::kColumn, voigt::kRow;
  const HexShape& shape = *law.shape;
  Mask valid = V(1.0) > V(0.0);
  for (int q = 0; q < 8; ++q) {
    V F[3][3];  // deformation gradient, [row i][column k]
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) {
        V sum = shape.dN[q][k][0] * x[i];
        for (int a = 1; a < 8; ++a) sum += shape.dN[q][k][a] * x[3 * a + i];
        F[i][k] = sum;
      }
    }
    const V minors[3] = {F[1][1] * F[2][2] - F[1][2] * F[2][1],
                         F[1][2] * F[2][0] - F[1][0] * F[2][2],
                         F[1][0] * F[2][1] - F[1][1] * F[2][0]};
    valid = valid & (dot(F[0], minors) > V(shape.dV[q] > 0.0 ? 0.0 : HUGE_VAL));
    V E[6], S[6], D[6][6];
    for (int r = 0; r < 6; ++r) {
      const int k = kRow[r], l = kColumn[r];
      const V C = F[0][k] * F[0][l] + (F[1][k] * F[1][l] + F[2][k] * F[2][l]);
      E[r] = r < 3 ? 0.5 * (C - 1.0) : C;
    }
    valid = valid & stress(law, shape.dV[q], E, S, D);
    if (dead) {
      for (int r = 0; r < 6; ++r) S[r] += shape.dV[q] * dead.solid(q, r);
    }
    for (int i = 0; i < 3; ++i) {
      V FS[3];
      times_strain_operator(F[i], S, FS);
      for (int a = 0; a < 8; ++a) {
        const auto* dN = shape.dN[q];
        V& f = sums.f[3 * a + i];
        f = dN[0][a] * FS[0] + (dN[1][a] * FS[1] + (dN[2][a] * FS[2] + f));
      }
    }
    if (stiffness) add_point_stiffness(shape.dN[q], F, S, D, sums);
  }
  return valid;
}

}  // namespace latsch::fe_tire::LATSCH_KERNELS
#endif
