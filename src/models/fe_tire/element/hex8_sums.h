// SPDX-License-Identifier: Apache-2.0
// Sums of the forces and stiffness of elements, first in terms of their modal vectors x_m = sum_a
// h_m[a] x_a, m = 1 ... 7 (hex8_solid_shell_modes.h), for which strains are simple, then of the
// nodes.
//
// The eighth modal vector, the mean of the nodes, translates the element without strain. Entries of
// h are +-1/8, so the transformation to the nodes needs only sums and differences: the fast
// Walsh-Hadamard transform in the three parent directions.
//
// This file is included once per kernel set, by hex8_kernels.h only.
#if defined(LATSCH_FE_TIRE_HEX8_SUMS) == defined(LATSCH_KERNEL_TOGGLE)
#ifdef LATSCH_FE_TIRE_HEX8_SUMS
#undef LATSCH_FE_TIRE_HEX8_SUMS
#else
#define LATSCH_FE_TIRE_HEX8_SUMS
#endif

#include "models/fe_tire/element/hex8_lanes.h"

namespace latsch::fe_tire::LATSCH_KERNELS {

inline constexpr int kModes = SolidShellShape::kModes;

/// Forces and stiffness by direction and modal vector. The blocks of K belong to pairs of
/// directions (i, j), j >= i, in Voigt order; blocks (i, i) hold only the entries n >= m.
template <class V>
struct ModalSumsOf {
  V f[3][kModes];
  V K[6][kModes][kModes];

  LATSCH_INLINE void set_zero(bool stiffness) {
    for (V& v : std::span(&f[0][0], 3 * kModes)) v = 0.0;
    if (!stiffness) return;
    for (V& v : std::span(&K[0][0][0], 6 * kModes * kModes)) v = 0.0;
  }
};

using ModalSums = ModalSumsOf<V>;

/// Forces and stiffness by node: f[3 a + i], K[entry(3 a + i, 3 b + j)] for nodes a, b and
/// directions i, j.
struct NodalSums {
  V f[24];
  V K[ElementBatch::kEntries];
};

/// Bits that say on which side of the element a node is: bit k is set on the side -1 of parent
/// direction k. Modal vectors are numbered by the same bits: 0 for xi, 1 for eta, 2 for zeta.
inline constexpr int kSideOfNode[8] = {7, 6, 4, 5, 3, 2, 0, 1};
inline constexpr int kPlaceOfMode[kModes] = {1, 2, 4, 3, 6, 5, 7};

/// Replaces pairs of values by their sums and differences, in each of the three directions.
LATSCH_INLINE void transform(V* v) {
  for (int step = 1; step < 8; step *= 2) {
    for (int k = 0; k < 8; ++k) {
      if (k & step) continue;
      const V a = v[k], b = v[k + step];
      v[k] = a + b;
      v[k + step] = a - b;
    }
  }
}

/// Computes the modal vectors from the positions x[3 a + i] of the nodes.
LATSCH_INLINE void modal_vectors(const V* x, V (*modal)[3]) {
  for (int i = 0; i < 3; ++i) {
    V v[8];
    for (int a = 0; a < 8; ++a) v[kSideOfNode[a]] = x[3 * a + i];
    transform(v);
    for (int m = 0; m < kModes; ++m) modal[m][i] = 0.125 * v[kPlaceOfMode[m]];
  }
}

LATSCH_INLINE void to_nodes(const ModalSums& modal, NodalSums& sums) {
  for (int i = 0; i < 3; ++i) {
    V v[8];
    v[0] = 0.0;
    for (int m = 0; m < kModes; ++m) v[kPlaceOfMode[m]] = 0.125 * modal.f[i][m];
    transform(v);
    for (int a = 0; a < 8; ++a) sums.f[3 * a + i] = v[kSideOfNode[a]];
  }
}

/// Transforms the stiffness block of the directions (i, j) to the nodes. `whole`: the block has all
/// entries, because i != j.
LATSCH_INLINE void block_to_nodes(const V (*block)[kModes], int i, int j, NodalSums& sums) {
  const bool whole = i != j;
  V rows[8][8];  // [index of the column's node][index of the row's modal vector]
  for (V& v : rows[0]) v = 0.0;
  V by_mode[kModes][8];
  for (int m = 0; m < kModes; ++m) {
    V* v = by_mode[m];
    v[0] = 0.0;
    for (int n = 0; n < kModes; ++n) {
      v[kPlaceOfMode[n]] = (1.0 / 64.0) * (whole || n >= m ? block[m][n] : block[n][m]);
    }
    transform(v);
  }
  for (int b = 0; b < 8; ++b) {
    V v[8];
    v[0] = 0.0;
    for (int m = 0; m < kModes; ++m) v[kPlaceOfMode[m]] = by_mode[m][kSideOfNode[b]];
    transform(v);
    for (int a = 0; a < 8; ++a) {  // K(a i, b j)
      const int row = 3 * a + i, column = 3 * b + j;
      if (!whole && row < column) continue;
      sums.K[row >= column ? ElementBatch::entry(row, column) : ElementBatch::entry(column, row)] =
          v[kSideOfNode[a]];
    }
  }
}

void stiffness_to_nodes(const ModalSums& modal, NodalSums& sums) {
  for (int block = 0; block < 6; ++block) {
    block_to_nodes(modal.K[block], voigt::kRow[block], voigt::kColumn[block], sums);
  }
}

/// Computes a tile of a matrix product: acc[r][c] += sum_k L[k][first_row + r] R[k][first_column +
/// c].
template <int rows, int columns, class V>
LATSCH_INLINE void tile(
    const V* left, int left_stride, const V* right, int right_stride, int count, V (*sum)[kModes]) {
  V acc[rows][columns];
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) acc[r][c] = sum[r][c];
  }
  for (int k = 0; k < count; ++k, left += left_stride, right += right_stride) {
    V b[columns];
    for (int c = 0; c < columns; ++c) b[c] = right[c];
    for (int r = 0; r < rows; ++r) {
      const V a = left[r];
      for (int c = 0; c < columns; ++c) acc[r][c] += a * b[c];
    }
  }
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) sum[r][c] = acc[r][c];
  }
}

/// Adds sum_k L_k^T R_k to the stiffness. L and R are stored as [row k][direction][modal vector].
template <class V>
void add_product(const V (*L)[3][kModes],
                 const V (*R)[3][kModes],
                 int count,
                 ModalSumsOf<V>& sums) {
  constexpr int stride = 3 * kModes;
  for (int block = 0; block < 6; ++block) {
    const int i = voigt::kRow[block], j = voigt::kColumn[block];
    const V *left = L[0][i], *right = R[0][j];
    V(*K)[kModes] = sums.K[block];
    tile<4, 3, V>(left, stride, right, stride, count, K);
    tile<4, 2, V>(left, stride, right + 3, stride, count, (V(*)[kModes])(K[0] + 3));
    tile<4, 2, V>(left, stride, right + 5, stride, count, (V(*)[kModes])(K[0] + 5));
    if (i != j) tile<3, 3, V>(left + 4, stride, right, stride, count, K + 4);
    tile<3, 2, V>(left + 4, stride, right + 3, stride, count, (V(*)[kModes])(K[4] + 3));
    tile<3, 2, V>(left + 4, stride, right + 5, stride, count, (V(*)[kModes])(K[4] + 5));
  }
}

}  // namespace latsch::fe_tire::LATSCH_KERNELS
#endif
