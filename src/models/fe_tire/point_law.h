// SPDX-License-Identifier: Apache-2.0
// The law of an element's solid at its eight Gauss points at once.
#pragma once

#include "models/fe_tire/rubber_law.h"

namespace latsch::fe_tire {

struct PointLaw {
  const Hyperelastic* rubber = nullptr;  // null: linear
  double D[6][6] = {};                   // of the linear law
};

/// S and D = dS/dE of the strain E, both times the points' volumes; false where det C <= 0.
LATSCH_INLINE bool stress(
    const PointLaw& law, const Lanes* E, const Lanes& dV, Lanes* S, Lanes (*D)[6]) {
  if (law.rubber != nullptr) {
    if (!rubber_law::stress(*law.rubber, E, S, D)) return false;
    for (int a = 0; a < 6; ++a) {
      S[a] *= dV;
      for (int b = 0; b < 6; ++b) D[a][b] *= dV;
    }
    return true;
  }
  for (int a = 0; a < 6; ++a) {
    Lanes s = {};
    for (int b = 0; b < 6; ++b) {
      s += law.D[a][b] * E[b];
      D[a][b] = law.D[a][b] * dV;
    }
    S[a] = s * dV;
  }
  Lanes C[6], Ci[6], det;
  return rubber_law::invert(E, C, Ci, det);
}

}  // namespace latsch::fe_tire
