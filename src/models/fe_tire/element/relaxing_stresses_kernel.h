// SPDX-License-Identifier: Apache-2.0
// Stresses whose history a rolling tire carries (rolling/rolling_history.h), at known displacements
// and enhanced strains.
//
// This file is included once per kernel set, by hex8_kernels.h only.
#if defined(LATSCH_FE_TIRE_RELAXING_STRESSES) == defined(LATSCH_KERNEL_TOGGLE)
#ifdef LATSCH_FE_TIRE_RELAXING_STRESSES
#undef LATSCH_FE_TIRE_RELAXING_STRESSES
#else
#define LATSCH_FE_TIRE_RELAXING_STRESSES
#endif

#include "models/fe_tire/element/hex8_full_integration_kernel.h"

namespace latsch::fe_tire::LATSCH_KERNELS {

/// Computes the strains at the points of the solid-shell, and the kinematics k of its modal vectors
/// k.x.
LATSCH_INLINE void strains_of_shell(const SolidShellShape& s,
                                    const V* alpha,
                                    Kinematics& k,
                                    V (*E)[6]) {
  V g[kStrains];
  follow(s, k);
  generalized_strains(s, k, g);
  for (int q = 0; q < 8; ++q) {
    for (int r = 0; r < 6; ++r) {
      V sum = s.P[q][r][0] * g[0];
      for (int j = 1; j < kStrains; ++j) sum += s.P[q][r][j] * g[j];
      for (int j = 0; j < kEnhanced; ++j) sum += s.P[q][r][kStrains + j] * alpha[j];
      E[q][r] = sum;
    }
  }
}

/// Computes the strains at the points of the comparison element with nodes at x[3 a + i].
LATSCH_INLINE void strains_of_comparison(const HexShape& shape, const V* x, V (*E)[6]) {
  using voigt::kColumn, voigt::kRow;
  for (int q = 0; q < 8; ++q) {
    V F[3][3];  // [column k][row i]
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) {
        V sum = shape.dN[q][k][0] * x[i];
        for (int a = 1; a < 8; ++a) sum += shape.dN[q][k][a] * x[3 * a + i];
        F[k][i] = sum;
      }
    }
    for (int r = 0; r < 6; ++r) {
      const V C = dot(F[kRow[r]], F[kColumn[r]]);
      E[q][r] = r < 3 ? 0.5 * (C - 1.0) : C;
    }
  }
}

void find_relaxing_stresses(const ElementLaw& law,
                            const ElementBatch& batch,
                            PointStresses& stresses) {
  const HexShape& shape = *law.shape;
  const Hyperelastic isochoric{law.rubber.C10, law.rubber.C01, 0.0};
  const bool is_shell = shape.kind == ElementKind::solid_shell;
  for (int first = 0; first < batch.count; first += V::kWidth) {
    V x[24], alpha[kEnhanced], E[8][6];
    Kinematics k;
    Cords cords(law.cords);
    for (int n = 0; n < 24; ++n) x[n] = load(batch.u[n] + first) + shape.X.data()[n];
    for (int j = 0; j < kEnhanced; ++j) alpha[j] = is_shell ? load(batch.alpha[j] + first) : V(0.0);
    modal_vectors(x, k.x);
    follow(k.x, cords);
    if (is_shell)
      strains_of_shell(shape.solid_shell, alpha, k, E);
    else
      strains_of_comparison(shape, x, E);
    for (int q = 0; q < 8; ++q) {
      V S[6], D[6][6];
      for (int r = 0; r < 6; ++r) S[r] = E[q][r];
      if (!law.linear) rubber_law::stress(isochoric, E[q], S, D);
      for (int r = 0; r < 6; ++r) S[r].save(stresses.solid[q][r] + first);
    }
    for (int j = 0; j < 3; ++j)
      V(law.relaxation * alpha[5 + j]).save(stresses.gradients[j] + first);
    stretch(cords, alpha[0], alpha[1]);
    for (int l = 0; l < cords.count(); ++l) {
      for (int q = 0; q < 4; ++q) cords.sheets[l].points[q].S.save(stresses.cords[l][q] + first);
    }
  }
}

}  // namespace latsch::fe_tire::LATSCH_KERNELS
#endif
