// SPDX-License-Identifier: Apache-2.0
// Elimination of the cyclic band and its solution (cyclic_band.h), panel by panel.
#include "models/ring_tire/belt/cyclic_band.h"
#include "numerics/kernels/kernel_lanes.h"

namespace latsch::ring_tire::LATSCH_KERNELS {

using namespace latsch::LATSCH_KERNELS;

constexpr int kRows = BandPanel::kRows, kNext = BandPanel::kNext, kLast = BandPanel::kLast,
              kBorder = BandPanel::kBorder, kBorderRows = BandPanel::kBorderRows;

/// Inverts a symmetric block, given by its lower triangle, by halves of two rows; returns false if
/// it is not positive definite. The inverse is exactly symmetric: eliminations would amplify
/// rounding differences between the triangles along the chain, from 1e-16 at its beginning to all
/// digits after a hundred nodes of a stiff belt.
LATSCH_INLINE bool invert(const double* S, int stride, double* inverse) {
  const auto at = [&](int r, int c) { return S[c * stride + r]; };
  const double a = at(0, 0), b = at(1, 0), c = at(1, 1), det = a * c - b * b;
  if (!(a > 0.0 && det > 0.0)) return false;
  const double over = 1.0 / det, p00 = c * over, p10 = -b * over, p11 = a * over;
  const double w20 = at(2, 0) * p00 + at(2, 1) * p10, w21 = at(2, 0) * p10 + at(2, 1) * p11,
               w30 = at(3, 0) * p00 + at(3, 1) * p10, w31 = at(3, 0) * p10 + at(3, 1) * p11;
  const double t22 = at(2, 2) - (w20 * at(2, 0) + w21 * at(2, 1)),
               t32 = at(3, 2) - (w30 * at(2, 0) + w31 * at(2, 1)),
               t33 = at(3, 3) - (w30 * at(3, 0) + w31 * at(3, 1)), rest = t22 * t33 - t32 * t32;
  if (!(t22 > 0.0 && rest > 0.0)) return false;
  const double of_rest = 1.0 / rest, q22 = t33 * of_rest, q32 = -t32 * of_rest, q33 = t22 * of_rest;
  const double u20 = q22 * w20 + q32 * w30, u21 = q22 * w21 + q32 * w31,
               u30 = q32 * w20 + q33 * w30, u31 = q32 * w21 + q33 * w31;
  inverse[0] = p00 + (w20 * u20 + w30 * u30);
  inverse[1] = inverse[4] = p10 + (w20 * u21 + w30 * u31);
  inverse[5] = p11 + (w21 * u21 + w31 * u31);
  inverse[2] = inverse[8] = -u20;
  inverse[3] = inverse[12] = -u30;
  inverse[6] = inverse[9] = -u21;
  inverse[7] = inverse[13] = -u31;
  inverse[10] = q22;
  inverse[11] = inverse[14] = q32;
  inverse[15] = q33;
  return true;
}

/// Returns y - L x; the columns of L are `stride` apart.
LATSCH_INLINE Lanes4 less_times(const Lanes4& y, const double* L, int stride, const double* x) {
  return (y - lanes4(L) * x[0] - lanes4(L + stride) * x[1]) -
         (lanes4(L + 2 * stride) * x[2] + lanes4(L + 3 * stride) * x[3]);
}
LATSCH_INLINE Lanes less_times(const Lanes& y, const double* L, int stride, const double* x) {
  return (y - lanes(L) * x[0] - lanes(L + stride) * x[1]) -
         (lanes(L + 2 * stride) * x[2] + lanes(L + 3 * stride) * x[3]);
}

/// Computes to - A b; A has four columns in registers, b four numbers `apart`.
LATSCH_INLINE void subtract(double* to, const Lanes* A, const double* b, int apart) {
  store(lanes(to) - A[0] * b[0] - A[1] * b[apart] - A[2] * b[2 * apart] - A[3] * b[3 * apart], to);
}
LATSCH_INLINE void subtract(double* to, const Lanes4* A, const double* b, int apart) {
  store(lanes4(to) - A[0] * b[0] - A[1] * b[apart] - A[2] * b[2 * apart] - A[3] * b[3 * apart], to);
}

/// Rows of a panel below its diagonal: two neighbors, the third; two nodes of the border, its last.
struct PanelRows {
  Lanes near, border;
  Lanes4 third, last;
};

LATSCH_INLINE PanelRows rows_of(const double* column) {
  return {.near = lanes(column + kNext),
          .border = lanes(column + kBorder),
          .third = lanes4(column + kLast),
          .last = lanes4(column + kBorder + 8)};
}

/// Eliminates the node of a panel from its three neighbors, whose panels follow, and from the
/// border if that counts. The node's rows of A become those of L, its diagonal the inverse.
template <bool with_border>
LATSCH_INLINE bool eliminate(double* panel, double* border) {
  double inverse[16];
  if (!invert(panel, kRows, inverse)) return false;
  // Registers of L are grouped as they are used with the panels.
  Lanes near[4], shifted[4], of_border[4];
  Lanes4 first[4], second[4], lone[4], border_high[4], border_last[4];
  {
    PanelRows A[4];
    for (int a = 0; a < 4; ++a) A[a] = rows_of(panel + kRows * a);
    for (int c = 0; c < 4; ++c) {
      const double* s = inverse + 4 * c;
      near[c] = A[0].near * s[0] + A[1].near * s[1] + (A[2].near * s[2] + A[3].near * s[3]);
      lone[c] = A[0].third * s[0] + A[1].third * s[1] + (A[2].third * s[2] + A[3].third * s[3]);
      first[c] = low_half(near[c]);
      second[c] = high_half(near[c]);
      shifted[c] = joined(second[c], lone[c]);
      if constexpr (with_border) {
        of_border[c] =
            A[0].border * s[0] + A[1].border * s[1] + (A[2].border * s[2] + A[3].border * s[3]);
        border_last[c] =
            A[0].last * s[0] + A[1].last * s[1] + (A[2].last * s[2] + A[3].last * s[3]);
        border_high[c] = high_half(of_border[c]);
      }
    }
  }
  // One register of L is processed after the other, so that AVX2 has enough registers for its
  // columns.
  if constexpr (with_border) {
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i)
#pragma GCC unroll 4
      for (int c = 0; c < 4; ++c) {
        double* const to = panel + (i + 1) * BandPanel::kSize + kRows * c + kBorder;
        const double* const b = panel + kNext + 4 * i + c;
        subtract(to, of_border, b, kRows);
        subtract(to + 8, border_last, b, kRows);
      }
#pragma GCC unroll 4
    for (int c = 0; c < 4; ++c) {
      double* const to = border + kBorderRows * c;
      const double* const b = panel + kBorder + c;
      subtract(to, of_border, b, kRows);
      subtract(to + 8, border_last, b, kRows);
    }
#pragma GCC unroll 4
    for (int c = 0; c < 4; ++c) {
      double* const to = border + kBorderRows * (4 + c) + 4;
      const double* const b = panel + kBorder + 4 + c;
      subtract(to, border_high, b, kRows);
      subtract(to + 4, border_last, b, kRows);
      subtract(to + 4 * kBorderRows + 4, border_last, b + 4, kRows);
    }
  }
#pragma GCC unroll 4
  for (int c = 0; c < 4; ++c) {
    double* const to = panel + BandPanel::kSize + kRows * c;
    const double* const b = panel + kNext + c;
    subtract(to, first, b, kRows);
    subtract(to + kNext, shifted, b, kRows);
  }
#pragma GCC unroll 4
  for (int c = 0; c < 4; ++c) {
    double* const to = panel + 2 * BandPanel::kSize + kRows * c;
    const double* const b = panel + kNext + 4 + c;
    subtract(to, second, b, kRows);
    subtract(to + kNext, lone, b, kRows);
    subtract(to + BandPanel::kSize, lone, b + 4, kRows);
  }
  for (int c = 0; c < 4; ++c) {
    double* const to = panel + kRows * c;
    store(lanes4(inverse + 4 * c), to);
    store(near[c], to + kNext);
    store(lone[c], to + kLast);
    if constexpr (with_border) {
      store(of_border[c], to + kBorder);
      store(border_last[c], to + kBorder + 8);
    }
  }
  return true;
}

/// True if L of the border is below `least` in this panel and the two before it.
LATSCH_INLINE bool faded(const double* panel, double least) {
  Lanes squares = all(0.0);
  Lanes4 last = Lanes4(0.0);
  for (const double* of = panel - 2 * BandPanel::kSize; of <= panel; of += BandPanel::kSize)
    for (int c = 0; c < 4; ++c) {
      const Lanes x = lanes(of + kRows * c + kBorder);
      const Lanes4 y = lanes4(of + kRows * c + kBorder + 8);
      squares = squares + x * x;
      last = last + y * y;
    }
  return sum(low_half(squares) + high_half(squares) + last) < least * least;
}

/// `panels` has one panel for each node and three panels of zeros. `border` is 12 x 12; the lower
/// triangle of its blocks counts. `least`, `far`: see CyclicBandFactor.
bool eliminate_chain(int interior, double* panels, double* border, double least, int& far) {
  constexpr int kLooks = 4;  // nodes from one check to the next
  far = interior - 3;
  for (int k = 0; k < interior; ++k) {
    double* const panel = panels + k * BandPanel::kSize;
    const bool beside = k < far || k >= interior - 3;
    if (!(beside ? eliminate<true>(panel, border) : eliminate<false>(panel, border))) return false;
    if (least > 0.0 && k % kLooks == kLooks - 1 && k < far && faded(panel, least)) far = k + 1;
  }
  for (int k = 0; k < 3; ++k) {
    double* const own = border + (kBorderRows + 1) * 4 * k;
    double inverse[16];
    if (!invert(own, kBorderRows, inverse)) return false;
    Lanes4 A[8];  // index: block below the diagonal, column
    double old[32];
    for (int i = k + 1; i < 3; ++i)
      for (int c = 0; c < 4; ++c) {
        const int at = 4 * (i - k - 1) + c;
        A[at] = lanes4(own + kBorderRows * c + 4 * (i - k));
        store(A[at], old + 4 * at);
      }
    for (int i = k + 1; i < 3; ++i) {
      const Lanes4* of = A + 4 * (i - k - 1);
      Lanes4 L[4];
      for (int c = 0; c < 4; ++c) {
        const double* s = inverse + 4 * c;
        L[c] = of[0] * s[0] + of[1] * s[1] + (of[2] * s[2] + of[3] * s[3]);
        store(L[c], own + kBorderRows * c + 4 * (i - k));
      }
      for (int j = k + 1; j <= i; ++j)
        for (int c = 0; c < 4; ++c) {
          subtract(border + kBorderRows * (4 * j + c) + 4 * i, L, old + 16 * (j - k - 1) + c, 4);
        }
    }
    for (int c = 0; c < 4; ++c) store(lanes4(inverse + 4 * c), own + kBorderRows * c);
  }
  return true;
}

/// Computes x <- A x at every node; A has columns of four.
void turn_nodes(int nodes, const double* A, double* x) {
  const Lanes4 a0 = lanes4(A), a1 = lanes4(A + 4), a2 = lanes4(A + 8), a3 = lanes4(A + 12);
  for (int k = 0; k < nodes; ++k) {
    double* const own = x + 4 * k;
    store(a0 * own[0] + a1 * own[1] + (a2 * own[2] + a3 * own[3]), own);
  }
}

/// Returns D^-1 x.
LATSCH_INLINE Lanes4 diagonal_times(const double* inverse, int stride, const double* x) {
  return lanes4(inverse) * x[0] + lanes4(inverse + stride) * x[1] +
         (lanes4(inverse + 2 * stride) * x[2] + lanes4(inverse + 3 * stride) * x[3]);
}

/// The neighbors of the current node stay in registers, because values just stored by fours should
/// not be read by eights.
void solve_chain(int interior, int far, const double* panels, const double* border, double* x) {
  const auto beside = [&](int k) { return k < far || k >= interior - 3; };
  double* const at_border = x + 4 * interior;
  Lanes of_border = lanes(at_border);
  Lanes4 last = lanes4(at_border + 8), next[3];
  for (int i = 0; i < 3; ++i) next[i] = lanes4(x + 4 * (i + 1));
  for (int k = 0; k < interior; ++k) {
    const double *L = panels + k * BandPanel::kSize, *own = x + 4 * k;
    if (beside(k)) {
      of_border = less_times(of_border, L + kBorder, kRows, own);
      last = less_times(last, L + kBorder + 8, kRows, own);
    }
    for (int i = 0; i < 3; ++i) next[i] = less_times(next[i], L + kNext + 4 * i, kRows, own);
    if (k + 1 == interior) break;
    store(next[0], x + 4 * (k + 1));
    next[0] = next[1];
    next[1] = next[2];
    if (k + 4 < interior) next[2] = lanes4(x + 4 * (k + 4));
  }
  store(of_border, at_border);
  store(last, at_border + 8);
  for (int k = 0; k < 3; ++k)
    for (int i = k + 1; i < 3; ++i)
      store(less_times(lanes4(at_border + 4 * i),
                       border + kBorderRows * 4 * k + 4 * i,
                       kBorderRows,
                       at_border + 4 * k),
            at_border + 4 * i);
  for (int k = 2; k >= 0; --k) {
    double* const own = at_border + 4 * k;
    store(diagonal_times(border + (kBorderRows + 1) * 4 * k, kBorderRows, own), own);
    for (int i = k + 1; i < 3; ++i)
      for (int c = 0; c < 4; ++c)
        own[c] -=
            sum(lanes4(border + kBorderRows * (4 * k + c) + 4 * i) * lanes4(at_border + 4 * i));
  }
  of_border = joined(lanes4(at_border), lanes4(at_border + 4));
  last = lanes4(at_border + 8);
  for (Lanes4& node : next) node = Lanes4(0.0);
  for (int k = interior - 1; k >= 0; --k) {
    const double* const L = panels + k * BandPanel::kSize;
    const Lanes near = joined(next[0], next[1]);
    const bool with_border = beside(k);
    double less[4];
    for (int c = 0; c < 4; ++c) {
      const PanelRows column = rows_of(L + kRows * c);
      Lanes eight = column.near * near;
      Lanes4 rest = column.third * next[2];
      if (with_border) {
        eight = eight + column.border * of_border;
        rest = rest + column.last * last;
      }
      less[c] = sum(low_half(eight) + high_half(eight) + rest);
    }
    next[2] = next[1];
    next[1] = next[0];
    next[0] = diagonal_times(L, kRows, x + 4 * k) - four(less[0], less[1], less[2], less[3]);
    store(next[0], x + 4 * k);
  }
}

/// The four unknowns of a node in eight columns.
struct Rows4 {
  Lanes v[4] = {all(0.0), all(0.0), all(0.0), all(0.0)};

  Rows4() = default;
  LATSCH_INLINE Rows4(const double* x, int stride)
      : v{lanes(x), lanes(x + stride), lanes(x + 2 * stride), lanes(x + 3 * stride)} {}
  LATSCH_INLINE void save(double* x, int stride) const {
    for (int i = 0; i < 4; ++i) store(v[i], x + i * stride);
  }
  /// Columns of A and L are `apart`.
  LATSCH_INLINE void add_times(const double* A, int apart, const Rows4& x) {
    for (int i = 0; i < 4; ++i)
      v[i] = (v[i] + x.v[0] * A[i] + x.v[1] * A[apart + i]) +
             (x.v[2] * A[2 * apart + i] + x.v[3] * A[3 * apart + i]);
  }
  LATSCH_INLINE void add_transposed(const double* A, const Rows4& x) {
    for (int i = 0; i < 4; ++i)
      v[i] = (v[i] + x.v[0] * A[4 * i] + x.v[1] * A[4 * i + 1]) +
             (x.v[2] * A[4 * i + 2] + x.v[3] * A[4 * i + 3]);
  }
  /// Subtracts L x.
  LATSCH_INLINE void less_times(const double* L, int apart, const Rows4& x) {
    for (int i = 0; i < 4; ++i)
      v[i] = (v[i] - x.v[0] * L[i] - x.v[1] * L[apart + i]) -
             (x.v[2] * L[2 * apart + i] + x.v[3] * L[3 * apart + i]);
  }
  /// Subtracts L^T x.
  LATSCH_INLINE void less_transposed(const double* L, int apart, const Rows4& x) {
    for (int i = 0; i < 4; ++i)
      v[i] = (v[i] - x.v[0] * L[apart * i] - x.v[1] * L[apart * i + 1]) -
             (x.v[2] * L[apart * i + 2] + x.v[3] * L[apart * i + 3]);
  }
};

/// Computes y += A x around the ring for rows of length `columns`, eight columns at a time.
/// `blocks` has kReach + 1 blocks for each node.
void add_product(
    int nodes, const Eigen::Matrix4d* blocks, const double* x, double* y, int columns) {
  constexpr int kReach = CyclicBand::kReach;
  for (int first = 0; first < columns; first += 8)
    for (int k = 0; k < nodes; ++k) {
      const Rows4 own(x + 4 * k * columns + first, columns);
      double* const to = y + 4 * k * columns + first;
      Rows4 sum(to, columns);
      for (int j = 0; j <= kReach; ++j) {
        const int other = 4 * ((k + j) % nodes) * columns + first;
        const double* const A = blocks[k * (kReach + 1) + j].data();
        sum.add_times(A, 4, Rows4(x + other, columns));
        if (j == 0) continue;
        Rows4 there(y + other, columns);
        there.add_transposed(A, own);
        there.save(y + other, columns);
      }
      sum.save(to, columns);
    }
}

/// Applies turn_nodes to `columns` columns side by side, eight at a time; rows are `stride` apart.
void turn_columns(int nodes, const double* A, double* x, int columns, int stride) {
  for (int k = 0; k < nodes; ++k)
    for (int first = 0; first < columns; first += 8) {
      double* const own = x + 4 * k * stride + first;
      Rows4 turned;
      turned.add_times(A, 4, Rows4(own, stride));
      turned.save(own, stride);
    }
}

/// Applies solve_chain to `columns` right-hand sides side by side, eight at a time; rows are
/// `stride` apart.
void solve_chain_of_columns(int interior,
                            int far,
                            const double* panels,
                            const double* border,
                            double* all_columns,
                            int columns,
                            int stride) {
  const auto beside = [&](int k) { return k < far || k >= interior - 3; };
  for (double* x = all_columns; x != all_columns + columns; x += 8) {
    const auto at = [&](int node) { return x + 4 * node * stride; };
    // Subtracts L times `other` from `node`.
    const auto less = [&](int node, const double* L, int apart, const Rows4& other) {
      Rows4 y(at(node), stride);
      y.less_times(L, apart, other);
      y.save(at(node), stride);
    };
    const auto reach = [&](int k) { return interior - 1 - k < 3 ? interior - 1 - k : 3; };
    for (int k = 0; k < interior; ++k) {
      const double* const L = panels + k * BandPanel::kSize;
      const Rows4 own(at(k), stride);
      for (int i = 0; i < reach(k); ++i) less(k + 1 + i, L + kNext + 4 * i, kRows, own);
      if (!beside(k)) continue;
      for (int i = 0; i < 3; ++i) less(interior + i, L + kBorder + 4 * i, kRows, own);
    }
    const auto border_block = [&](int row, int column) {
      return border + kBorderRows * 4 * column + 4 * row;
    };
    for (int k = 0; k < 3; ++k)
      for (int i = k + 1; i < 3; ++i)
        less(interior + i, border_block(i, k), kBorderRows, Rows4(at(interior + k), stride));
    for (int k = 2; k >= 0; --k) {
      Rows4 y;
      y.add_times(border_block(k, k), kBorderRows, Rows4(at(interior + k), stride));
      for (int i = k + 1; i < 3; ++i)
        y.less_transposed(border_block(i, k), kBorderRows, Rows4(at(interior + i), stride));
      y.save(at(interior + k), stride);
    }
    for (int k = interior - 1; k >= 0; --k) {
      const double* const L = panels + k * BandPanel::kSize;
      Rows4 y;
      y.add_times(L, kRows, Rows4(at(k), stride));
      for (int i = 0; i < reach(k); ++i)
        y.less_transposed(L + kNext + 4 * i, kRows, Rows4(at(k + 1 + i), stride));
      if (beside(k))
        for (int i = 0; i < 3; ++i)
          y.less_transposed(L + kBorder + 4 * i, kRows, Rows4(at(interior + i), stride));
      y.save(at(k), stride);
    }
  }
}

}  // namespace latsch::ring_tire::LATSCH_KERNELS
