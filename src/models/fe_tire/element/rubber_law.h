// SPDX-License-Identifier: Apache-2.0
// Mooney-Rivlin rubber with a volumetric penalty, decoupled into isochoric and volumetric parts:
//   W = C10 (J^(-2/3) I1 - 3) + C01 (J^(-4/3) I2 - 3) + K/2 (J - 1)^2,    I2 = (I1^2 - C:C) / 2
//   S = 2 dW/dC,  D = 4 d2W/dC2
// from dI1/dC = I, dI2/dC = I1 I - C, dJ/dC = J C^-1 / 2, dC^-1/dC = -C^-1 (.) C^-1.
// Holds for moderate strain (rubber below about 100 %); no Mullins effect, no viscosity.
// [Holzapfel 2000] Nonlinear Solid Mechanics, sections 6.4-6.6.
//
// This file is included once per kernel set, by hex8_kernels.h only.
#if defined(LATSCH_FE_TIRE_RUBBER_LAW) == defined(LATSCH_KERNEL_TOGGLE)
#ifdef LATSCH_FE_TIRE_RUBBER_LAW
#undef LATSCH_FE_TIRE_RUBBER_LAW
#else
#define LATSCH_FE_TIRE_RUBBER_LAW
#endif

#include "models/fe_tire/element/hex8_lanes.h"

namespace latsch::fe_tire::LATSCH_KERNELS::rubber_law {

/// Computes the matrix C and its inverse (Voigt order) from the strain E.
LATSCH_INLINE void invert(const V* E, V* C, V* Ci, V& det) {
  for (int k = 0; k < 6; ++k) C[k] = k < 3 ? 2.0 * E[k] + 1.0 : E[k];
  Ci[0] = C[1] * C[2] - C[4] * C[4];
  Ci[1] = C[0] * C[2] - C[5] * C[5];
  Ci[2] = C[0] * C[1] - C[3] * C[3];
  Ci[3] = C[4] * C[5] - C[3] * C[2];
  Ci[4] = C[3] * C[5] - C[0] * C[4];
  Ci[5] = C[3] * C[4] - C[1] * C[5];
  det = C[0] * Ci[0] + (C[3] * Ci[3] + C[5] * Ci[5]);
  const V inverse = 1.0 / det;
  for (int k = 0; k < 6; ++k) Ci[k] *= inverse;
}

/// Computes the symmetric tangent D = ci (C^-1 (.) C^-1) + A x C^-1 + C^-1 x A.
LATSCH_INLINE void tangent(const V* Ci, const V* A, const V& ci, V (*D)[6]) {
  using voigt::kPlace;
  const V half = 0.5 * ci;
  for (int a = 0; a < 6; ++a) {
    for (int b = a; b < 6; ++b) {
      const int i = voigt::kRow[a], j = voigt::kColumn[a];
      const int k = voigt::kRow[b], l = voigt::kColumn[b];
      const V product = Ci[kPlace[i][k]] * Ci[kPlace[j][l]] + Ci[kPlace[i][l]] * Ci[kPlace[j][k]];
      D[a][b] = D[b][a] = half * product + (A[a] * Ci[b] + Ci[a] * A[b]);
    }
  }
}

/// Computes S and D = dS/dE at the strain E and returns det C. If det C is not positive, S and D
/// are undefined.
LATSCH_INLINE V stress(const Hyperelastic& law, const V* E, V* S, V (*D)[6]) {
  V C[6], Ci[6], det;
  invert(E, C, Ci, det);
  const V J = sqrt(det), j = inverse_cube_root(det);  // j = J^(-2/3)
  const V I1 = C[0] + C[1] + C[2];
  const V shear = C[3] * C[3] + (C[4] * C[4] + C[5] * C[5]);
  const V CC = 2.0 * shear + (C[0] * C[0] + (C[1] * C[1] + C[2] * C[2]));
  const V I2 = 0.5 * (I1 * I1 - CC);
  const V a = 2.0 * law.C10 * j, jj = j * j, b = 2.0 * law.C01 * jj;
  const V aI1 = a * I1, bI2 = b * I2, KJ = law.K * J;
  const V pJ = KJ * (J - 1.0);
  const V s = pJ - (aI1 * (1.0 / 3.0) + bI2 * (2.0 / 3.0));  // coefficient of C^-1
  const V cc = (2.0 / 9.0) * (aI1 + 4.0 * bI2) + KJ * (2.0 * J - 1.0);
  const V ci = (2.0 / 3.0) * (aI1 + 2.0 * bI2) - 2.0 * pJ;
  V A[6];  // includes half of the term cc C^-1 x C^-1
  for (int k = 0; k < 6; ++k) {
    const V B = k < 3 ? I1 - C[k] : -C[k];  // derivative dI2/dC
    const V bB = b * B;
    S[k] = k < 3 ? s * Ci[k] + bB + a : s * Ci[k] + bB;
    A[k] = (0.5 * cc) * Ci[k] - bB * (4.0 / 3.0);
    if (k < 3) A[k] = A[k] - a * (2.0 / 3.0);
  }
  tangent(Ci, A, ci, D);
  for (int k = 0; k < 3; ++k) {  // b (2 I x I - 2 1)
    D[k][(k + 1) % 3] += 2.0 * b;
    D[k][(k + 2) % 3] += 2.0 * b;
    D[k + 3][k + 3] -= b;
  }
  return det;
}

}  // namespace latsch::fe_tire::LATSCH_KERNELS::rubber_law
#endif
