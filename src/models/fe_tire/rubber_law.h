// SPDX-License-Identifier: Apache-2.0
// Mooney-Rivlin rubber with a volumetric penalty, decoupled into isochoric and volumetric parts:
//   W = C10 (J^(-2/3) I1 - 3) + C01 (J^(-4/3) I2 - 3) + K/2 (J - 1)^2,    I2 = (I1^2 - C:C) / 2
//   S = 2 dW/dC,  D = 4 d2W/dC2
// from dI1/dC = I, dI2/dC = I1 I - C, dJ/dC = J C^-1 / 2, dC^-1/dC = -C^-1 (.) C^-1.
// Holds for moderate strain (rubber below about 100 %); no Mullins effect, no viscosity.
// [Holzapfel 2000] Nonlinear Solid Mechanics, sections 6.4-6.6.
//
// Written once for T = double and for T = Lanes, eight points at a time.
#pragma once

#include <cmath>

#include "numerics/lanes.h"
#include "models/fe_tire/materials.h"

namespace latsch::fe_tire::rubber_law {

/// Place of the component (i, j) in Voigt order.
inline constexpr int kVoigt[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
inline constexpr int kRow[6] = {0, 1, 2, 0, 1, 0};
inline constexpr int kColumn[6] = {0, 1, 2, 1, 2, 2};

/// J = sqrt(det C) and j = det C^(-1/3) = J^(-2/3).
LATSCH_INLINE void roots(double det, double& J, double& j) {
  J = std::sqrt(det);
  j = 1.0 / std::cbrt(det);
}
LATSCH_INLINE void roots(const Lanes& det, Lanes& J, Lanes& j) {
  for (int q = 0; q < 8; ++q) {
    J[q] = std::sqrt(det[q]);
    j[q] = std::cbrt(det[q]);
  }
  j = 1.0 / j;
}
LATSCH_INLINE bool positive(double det) { return det > 0.0; }
LATSCH_INLINE bool positive(const Lanes& det) {
  bool all_positive = true;
  for (int q = 0; q < 8; ++q) all_positive &= det[q] > 0.0;
  return all_positive;
}

/// C and its inverse (Voigt) from the strain E; false where det C <= 0.
template <class T>
LATSCH_INLINE bool invert(const T* E, T* C, T* Ci, T& det) {
  for (int k = 0; k < 6; ++k) C[k] = k < 3 ? 2.0 * E[k] + 1.0 : E[k];
  Ci[0] = C[1] * C[2] - C[4] * C[4];
  Ci[1] = C[0] * C[2] - C[5] * C[5];
  Ci[2] = C[0] * C[1] - C[3] * C[3];
  Ci[3] = C[4] * C[5] - C[3] * C[2];
  Ci[4] = C[3] * C[5] - C[0] * C[4];
  Ci[5] = C[3] * C[4] - C[1] * C[5];
  det = C[0] * Ci[0] + C[3] * Ci[3] + C[5] * Ci[5];
  const T inverse = 1.0 / det;
  for (int k = 0; k < 6; ++k) Ci[k] = Ci[k] * inverse;
  return positive(det);
}

/// D += ci (C^-1 (.) C^-1) + A x C^-1 + C^-1 x A + cc C^-1 x C^-1, symmetric.
template <class T>
LATSCH_INLINE void tangent(const T* Ci, const T* A, const T& cc, const T& ci, T (*D)[6]) {
  for (int a = 0; a < 6; ++a) {
    for (int b = a; b < 6; ++b) {
      const int i = kRow[a], j = kColumn[a], k = kRow[b], l = kColumn[b];
      const T product =
          0.5 * (Ci[kVoigt[i][k]] * Ci[kVoigt[j][l]] + Ci[kVoigt[i][l]] * Ci[kVoigt[j][k]]);
      D[a][b] = D[b][a] = ci * product + A[a] * Ci[b] + Ci[a] * A[b] + cc * Ci[a] * Ci[b];
    }
  }
}

template <class T>
LATSCH_INLINE bool stress(const Hyperelastic& law, const T* E, T* S, T (*D)[6]) {
  T C[6], Ci[6], det, J = {}, j = {};
  if (!invert(E, C, Ci, det)) return false;
  roots(det, J, j);
  const T I1 = C[0] + C[1] + C[2];
  const T CC =
      C[0] * C[0] + C[1] * C[1] + C[2] * C[2] + 2.0 * (C[3] * C[3] + C[4] * C[4] + C[5] * C[5]);
  const T I2 = 0.5 * (I1 * I1 - CC);
  const T a = 2.0 * law.C10 * j, b = 2.0 * law.C01 * j * j;
  const T pJ = law.K * (J - 1.0) * J;
  const T s = pJ - a * I1 * (1.0 / 3.0) - b * I2 * (2.0 / 3.0);  // along C^-1
  T A[6];
  for (int k = 0; k < 6; ++k) {
    const T B = k < 3 ? I1 - C[k] : -C[k];  // dI2/dC
    S[k] = b * B + s * Ci[k];
    A[k] = b * B * (-4.0 / 3.0);
    if (k < 3) {
      S[k] = S[k] + a;
      A[k] = A[k] - a * (2.0 / 3.0);
    }
  }
  const T cc = (2.0 / 9.0) * (a * I1 + 4.0 * b * I2) + law.K * (2.0 * J - 1.0) * J;
  const T ci = (2.0 / 3.0) * (a * I1 + 2.0 * b * I2) - 2.0 * pJ;
  tangent(Ci, A, cc, ci, D);
  for (int k = 0; k < 3; ++k) {  // b (2 I x I - 2 1)
    D[k][(k + 1) % 3] = D[k][(k + 1) % 3] + 2.0 * b;
    D[k][(k + 2) % 3] = D[k][(k + 2) % 3] + 2.0 * b;
    D[k + 3][k + 3] = D[k + 3][k + 3] - b;
  }
  return true;
}

}  // namespace latsch::fe_tire::rubber_law
