// SPDX-License-Identifier: Apache-2.0
// Elimination of the cyclic band (cyclic_band.h), blocks of 4 x 4, columns one after the other.
#include "numerics/kernels/kernel_lanes.h"

namespace latsch::ring_tire::LATSCH_KERNELS {

using namespace latsch::LATSCH_KERNELS;

/// C <- C - L A^T, columns of 4.
LATSCH_INLINE void subtract_product(double* C, const double* L, const double* A) {
  const Lanes4 l0 = lanes4(L), l1 = lanes4(L + 4), l2 = lanes4(L + 8), l3 = lanes4(L + 12);
  for (int c = 0; c < 4; ++c)
    store(lanes4(C + 4 * c) - l0 * A[c] - l1 * A[4 + c] - l2 * A[8 + c] - l3 * A[12 + c],
          C + 4 * c);
}

/// A <- A S, S symmetric; `old` keeps A. By whole columns: copied by halves, A would be read back
/// before its halves have met, at ten times the wait.
LATSCH_INLINE void multiply(double* A, double* old, const double* S) {
  const Lanes4 a0 = lanes4(A), a1 = lanes4(A + 4), a2 = lanes4(A + 8), a3 = lanes4(A + 12);
  store(a0, old);
  store(a1, old + 4);
  store(a2, old + 8);
  store(a3, old + 12);
  for (int c = 0; c < 4; ++c) {
    const double* s = S + 4 * c;
    store(a0 * s[0] + a1 * s[1] + (a2 * s[2] + a3 * s[3]), A + 4 * c);
  }
}

/// y - L x
LATSCH_INLINE Lanes4 less_times(const Lanes4& y, const double* L, const double* x) {
  return (y - lanes4(L) * x[0] - lanes4(L + 4) * x[1]) -
         (lanes4(L + 8) * x[2] + lanes4(L + 12) * x[3]);
}

/// y <- y - L x.
LATSCH_INLINE void subtract_times(double* y, const double* L, const double* x) {
  store(less_times(lanes4(y), L, x), y);
}

/// y <- y - L^T x.
LATSCH_INLINE void subtract_transposed(double* y, const double* L, const double* x) {
  const Lanes4 v = lanes4(x);
  for (int c = 0; c < 4; ++c) y[c] -= sum(lanes4(L + 4 * c) * v);
}

/// S <- S^-1 by sweeps without pivoting; false where S is not positive definite. What rounding has
/// left between the two triangles is dropped: eliminations would let it grow along the chain, 1e-16
/// at its beginning to all digits after a hundred nodes of a stiff belt.
LATSCH_INLINE bool invert(double* S) {
  for (int c = 0; c < 4; ++c)
    for (int r = c + 1; r < 4; ++r) S[4 * r + c] = S[4 * c + r];
  for (int p = 0; p < 4; ++p) {
    const double pivot = S[5 * p];
    if (!(pivot > 0.0)) return false;
    const double inverse = 1.0 / pivot;
    const Lanes4 column = lanes4(S + 4 * p) * inverse;
    for (int c = 0; c < 4; ++c) {
      if (c == p) continue;
      const double factor = S[4 * c + p];
      store(lanes4(S + 4 * c) - column * factor, S + 4 * c);
      S[4 * c + p] = factor * inverse;
    }
    store(-column, S + 4 * p);
    S[5 * p] = inverse;
  }
  return true;
}

/// Eliminates node k of an open chain of `interior` nodes. `column` k: blocks to k+1 .. k+3, then
/// to the three nodes of the border; `border`: 12 x 12.
LATSCH_INLINE bool eliminate(int k,
                             int interior,
                             Eigen::Matrix4d* diagonal,
                             Eigen::Matrix4d* lower,
                             Eigen::Matrix4d* border) {
  constexpr int kReach = CyclicBand::kReach, kColumn = kReach + 3;
  double* inverse = diagonal[k].data();
  if (!invert(inverse)) return false;
  Eigen::Matrix4d* column = lower + k * kColumn;
  const int reach = interior - 1 - k < kReach ? interior - 1 - k : kReach;
  Eigen::Matrix4d old[kColumn];
  for (int i = 0; i < kColumn; ++i) {
    if (i >= reach && i < kReach) continue;
    multiply(column[i].data(), old[i].data(), inverse);
  }
  for (int i = 0; i < reach; ++i) {
    subtract_product(diagonal[k + 1 + i].data(), column[i].data(), old[i].data());
    Eigen::Matrix4d* next = lower + (k + 1 + i) * kColumn;
    for (int j = i + 1; j < reach; ++j)
      subtract_product(next[j - i - 1].data(), column[j].data(), old[i].data());
    for (int j = kReach; j < kColumn; ++j)
      subtract_product(next[j].data(), column[j].data(), old[i].data());
  }
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j <= i; ++j)
      subtract_product(border[3 * i + j].data(), column[kReach + i].data(), old[kReach + j].data());
  return true;
}

bool eliminate_chain(int interior,
                     Eigen::Matrix4d* diagonal,
                     Eigen::Matrix4d* lower,
                     Eigen::Matrix4d* border) {
  for (int k = 0; k < interior; ++k)
    if (!eliminate(k, interior, diagonal, lower, border)) return false;
  // The border itself, a full matrix of three by three blocks.
  for (int k = 0; k < 3; ++k) {
    if (!invert(border[4 * k].data())) return false;
    Eigen::Matrix4d old[3];
    for (int i = k + 1; i < 3; ++i) {
      multiply(border[3 * i + k].data(), old[i].data(), border[4 * k].data());
    }
    for (int i = k + 1; i < 3; ++i)
      for (int j = k + 1; j <= i; ++j)
        subtract_product(border[3 * i + j].data(), border[3 * i + k].data(), old[j].data());
  }
  return true;
}

void solve_chain(int interior,
                 const Eigen::Matrix4d* inverse,
                 const Eigen::Matrix4d* lower,
                 const Eigen::Matrix4d* border,
                 double* x) {
  constexpr int kReach = CyclicBand::kReach, kColumn = kReach + 3;
  for (int k = 0; k < interior; ++k) {
    const Eigen::Matrix4d* column = lower + k * kColumn;
    const int reach = interior - 1 - k < kReach ? interior - 1 - k : kReach;
    for (int i = 0; i < reach; ++i)
      subtract_times(x + 4 * (k + 1 + i), column[i].data(), x + 4 * k);
    for (int i = 0; i < 3; ++i)
      subtract_times(x + 4 * (interior + i), column[kReach + i].data(), x + 4 * k);
  }
  for (int k = 0; k < 3; ++k)
    for (int i = k + 1; i < 3; ++i)
      subtract_times(x + 4 * (interior + i), border[3 * i + k].data(), x + 4 * (interior + k));
  for (int k = 0; k < interior + 3; ++k) {
    const double* D = k < interior ? inverse[k].data() : border[4 * (k - interior)].data();
    double y[4];
    store(lanes4(x + 4 * k), y);
    store(lanes4(D) * y[0] + lanes4(D + 4) * y[1] + (lanes4(D + 8) * y[2] + lanes4(D + 12) * y[3]),
          x + 4 * k);
  }
  for (int k = 2; k >= 0; --k)
    for (int i = k + 1; i < 3; ++i)
      subtract_transposed(x + 4 * (interior + k), border[3 * i + k].data(), x + 4 * (interior + i));
  for (int k = interior - 1; k >= 0; --k) {
    const Eigen::Matrix4d* column = lower + k * kColumn;
    const int reach = interior - 1 - k < kReach ? interior - 1 - k : kReach;
    for (int i = 0; i < reach; ++i)
      subtract_transposed(x + 4 * k, column[i].data(), x + 4 * (k + 1 + i));
    for (int i = 0; i < 3; ++i)
      subtract_transposed(x + 4 * k, column[kReach + i].data(), x + 4 * (interior + i));
  }
}

/// A node's four unknowns of eight columns.
struct Rows4 {
  Lanes v[4] = {all(0.0), all(0.0), all(0.0), all(0.0)};

  Rows4() = default;
  LATSCH_INLINE Rows4(const double* x, int stride)
      : v{lanes(x), lanes(x + stride), lanes(x + 2 * stride), lanes(x + 3 * stride)} {}
  LATSCH_INLINE void save(double* x, int stride) const {
    for (int i = 0; i < 4; ++i) store(v[i], x + i * stride);
  }
  LATSCH_INLINE void add_times(const double* A, const Rows4& x) {
    for (int i = 0; i < 4; ++i)
      v[i] = (v[i] + x.v[0] * A[i] + x.v[1] * A[4 + i]) + (x.v[2] * A[8 + i] + x.v[3] * A[12 + i]);
  }
  LATSCH_INLINE void add_transposed(const double* A, const Rows4& x) {
    for (int i = 0; i < 4; ++i)
      v[i] = (v[i] + x.v[0] * A[4 * i] + x.v[1] * A[4 * i + 1]) +
             (x.v[2] * A[4 * i + 2] + x.v[3] * A[4 * i + 3]);
  }
  /// - L x
  LATSCH_INLINE void less_times(const double* L, const Rows4& x) {
    for (int i = 0; i < 4; ++i)
      v[i] = (v[i] - x.v[0] * L[i] - x.v[1] * L[4 + i]) - (x.v[2] * L[8 + i] + x.v[3] * L[12 + i]);
  }
  /// - L^T x
  LATSCH_INLINE void less_transposed(const double* L, const Rows4& x) {
    for (int i = 0; i < 4; ++i)
      v[i] = (v[i] - x.v[0] * L[4 * i] - x.v[1] * L[4 * i + 1]) -
             (x.v[2] * L[4 * i + 2] + x.v[3] * L[4 * i + 3]);
  }
};

/// y += A x around the ring, rows `columns` long, eight columns at a time; blocks: kReach + 1 a
/// node.
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
        sum.add_times(A, Rows4(x + other, columns));
        if (j == 0) continue;
        Rows4 there(y + other, columns);
        there.add_transposed(A, own);
        there.save(y + other, columns);
      }
      sum.save(to, columns);
    }
}

/// solve_chain for `columns` right-hand sides side by side, eight at a time; rows `stride` apart.
void solve_chain_of_columns(int interior,
                            const Eigen::Matrix4d* inverse,
                            const Eigen::Matrix4d* lower,
                            const Eigen::Matrix4d* border,
                            double* all_columns,
                            int columns,
                            int stride) {
  constexpr int kReach = CyclicBand::kReach, kColumn = kReach + 3;
  for (double* x = all_columns; x != all_columns + columns; x += 8) {
    const auto at = [&](int node) { return x + 4 * node * stride; };
    // `node` less what `other` does to it by L, or by its transpose.
    const auto less = [&](int node, const Eigen::Matrix4d& L, const Rows4& other) {
      Rows4 y(at(node), stride);
      y.less_times(L.data(), other);
      y.save(at(node), stride);
    };
    for (int k = 0; k < interior; ++k) {
      const Eigen::Matrix4d* column = lower + k * kColumn;
      const int reach = interior - 1 - k < kReach ? interior - 1 - k : kReach;
      const Rows4 own(at(k), stride);
      for (int i = 0; i < reach; ++i) less(k + 1 + i, column[i], own);
      for (int i = 0; i < 3; ++i) less(interior + i, column[kReach + i], own);
    }
    for (int k = 0; k < 3; ++k)
      for (int i = k + 1; i < 3; ++i)
        less(interior + i, border[3 * i + k], Rows4(at(interior + k), stride));
    for (int k = interior + 2; k >= 0; --k) {
      const Rows4 own(at(k), stride);
      Rows4 y;
      y.add_times((k < interior ? inverse[k] : border[4 * (k - interior)]).data(), own);
      if (k >= interior) {
        for (int i = k - interior + 1; i < 3; ++i)
          y.less_transposed(border[3 * i + k - interior].data(), Rows4(at(interior + i), stride));
      } else {
        const Eigen::Matrix4d* column = lower + k * kColumn;
        const int reach = interior - 1 - k < kReach ? interior - 1 - k : kReach;
        for (int i = 0; i < reach; ++i)
          y.less_transposed(column[i].data(), Rows4(at(k + 1 + i), stride));
        for (int i = 0; i < 3; ++i)
          y.less_transposed(column[kReach + i].data(), Rows4(at(interior + i), stride));
      }
      y.save(at(k), stride);
    }
  }
}

}  // namespace latsch::ring_tire::LATSCH_KERNELS
