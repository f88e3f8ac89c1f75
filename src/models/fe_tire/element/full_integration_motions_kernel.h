// SPDX-License-Identifier: Apache-2.0
// Derivatives of strains and forces of the comparison element's solid along motions, (M.3) of
// hex8_motions.h.
//
// This file is included once per kernel set, by hex8_kernels.h only.
#if defined(LATSCH_FE_TIRE_FULL_INTEGRATION_MOTIONS) == defined(LATSCH_KERNEL_TOGGLE)
#ifdef LATSCH_FE_TIRE_FULL_INTEGRATION_MOTIONS
#undef LATSCH_FE_TIRE_FULL_INTEGRATION_MOTIONS
#else
#define LATSCH_FE_TIRE_FULL_INTEGRATION_MOTIONS
#endif

#include "models/fe_tire/element/rubber_motions_kernel.h"

namespace latsch::fe_tire::LATSCH_KERNELS {

/// Computes the deformation gradient F at a point of the comparison element, [row i][column k].
LATSCH_INLINE void gradient(const double (*dN)[8], const V* x, V (*F)[3]) {
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      V sum = dN[k][0] * x[i];
      for (int a = 1; a < 8; ++a) sum += dN[k][a] * x[3 * a + i];
      F[i][k] = sum;
    }
  }
}
/// Computes the symmetric part of F^T G in the order of engineering strains: normal components
/// once, shear components twice.
LATSCH_INLINE void strain_of(const V (*F)[3], const V (*G)[3], V* E) {
  for (int r = 0; r < 6; ++r) {
    const int k = voigt::kRow[r], l = voigt::kColumn[r];
    V sum = 0.0;
    for (int i = 0; i < 3; ++i) sum += F[i][k] * G[i][l];
    if (r >= 3) {
      for (int i = 0; i < 3; ++i) sum += F[i][l] * G[i][k];
    }
    E[r] = sum;
  }
}

/// Computes the sums (M.3) for the solid of the comparison element.
void curve_full_integration(const ElementLaw& law, const V* x, const V* phi, NodalSums& sums) {
  const HexShape& shape = *law.shape;
  for (int q = 0; q < kPoints; ++q) {
    V F[3][3], G[3][3], E[6], E1[6], E2[6], S[6], D[6][6], S1[6], S2[6];
    gradient(shape.dN[q], x, F);
    gradient(shape.dN[q], phi, G);
    strain_of(F, F, E);
    for (int r = 0; r < 6; ++r) E[r] = r < 3 ? V(0.5 * (E[r] - 1.0)) : V(0.5 * E[r]);
    strain_of(F, G, E1);
    strain_of(G, G, E2);
    stress(law, shape.dV[q], E, S, D);
    for (int r = 0; r < 6; ++r) S2[r] = 0.0;
    if (!law.linear) {
      RubberPoint point;
      prepare(law.rubber, E, point);
      second_stress(law.rubber, point, E1, S2);
    }
    for (int r = 0; r < 6; ++r) {
      S1[r] = 0.0;
      S2[r] = shape.dV[q] * S2[r];
      for (int c = 0; c < 6; ++c) {
        S1[r] += D[r][c] * E1[c];
        S2[r] += D[r][c] * E2[c];
      }
    }
    for (int i = 0; i < 3; ++i) {
      V a[3], b[3];
      times_strain_operator(F[i], S2, a);
      times_strain_operator(G[i], S1, b);
      for (int k = 0; k < 3; ++k) a[k] += 2.0 * b[k];
      for (int n = 0; n < 8; ++n) {
        const auto* dN = shape.dN[q];
        V& f = sums.f[3 * n + i];
        f = dN[0][n] * a[0] + (dN[1][n] * a[1] + (dN[2][n] * a[2] + f));
      }
    }
  }
}

}  // namespace latsch::fe_tire::LATSCH_KERNELS
#endif
