// SPDX-License-Identifier: Apache-2.0
// Force and stiffness of an element while they are summed up, the eight nodes side by side.
#pragma once

#include "models/fe_tire/hex8.h"
#include "numerics/lanes.h"

namespace latsch::fe_tire {

struct NodalSums {
  Lanes f[3];      // f[i][a]: node a, direction i
  Lanes K[24][3];  // K[8 i + a][j][b]; of the blocks (i, j) only those with j >= i are kept

  void set_zero(bool stiffness) {
    std::memset(f, 0, sizeof f);
    if (stiffness) std::memset(K, 0, sizeof K);
  }

  /// Into the order of the unknowns: 3 a + i.
  void write(Vector24& force, Matrix24* stiffness) const {
    for (int a = 0; a < 8; ++a) {
      for (int i = 0; i < 3; ++i) force[3 * a + i] = f[i][a];
    }
    if (stiffness == nullptr) return;
    for (int i = 0; i < 3; ++i) {
      for (int a = 0; a < 8; ++a) {
        for (int j = i; j < 3; ++j) {
          for (int b = i == j ? a : 0; b < 8; ++b) {
            const double k = K[8 * i + a][j][b];
            (*stiffness)(3 * a + i, 3 * b + j) = k;
            (*stiffness)(3 * b + j, 3 * a + i) = k;
          }
        }
      }
    }
  }
};

/// K += sum_r B_r DB_r^T over `rows` rows; B and DB are [row][direction][node].
template <int rows>
LATSCH_INLINE void add_product(const Lanes (*B)[3], const Lanes (*DB)[3], NodalSums& sums) {
  for (int i = 0; i < 3; ++i) {
    for (int a = 0; a < 8; ++a) {
      Lanes k0 = {}, k1 = {}, k2 = {};
      for (int r = 0; r < rows; ++r) {
        const Lanes b = all(B[r][i][a]);
        if (i == 0) k0 += b * DB[r][0];
        if (i <= 1) k1 += b * DB[r][1];
        k2 += b * DB[r][2];
      }
      Lanes* K = sums.K[8 * i + a];
      K[0] += k0;
      K[1] += k1;
      K[2] += k2;
    }
  }
}

/// The same geometric stiffness H[a][b] in all three directions.
LATSCH_INLINE void add_geometric(const Lanes* H, NodalSums& sums) {
  for (int i = 0; i < 3; ++i) {
    for (int a = 0; a < 8; ++a) sums.K[8 * i + a][i] += H[a];
  }
}

}  // namespace latsch::fe_tire
