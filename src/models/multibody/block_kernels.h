// SPDX-License-Identifier: Apache-2.0
// Operations on 6 x 6 blocks, stored by columns, with which BlockElimination eliminates and solves.
// A column is held in two vector registers of four numbers that overlap: rows 0 - 3 and rows 2 - 5.
#include "numerics/kernels/kernel_lanes.h"

namespace latsch::multibody::LATSCH_KERNELS {

using namespace latsch::LATSCH_KERNELS;

struct Six {
  Lanes4 upper, lower;

  Six() = default;
  LATSCH_INLINE Six(const Lanes4& u, const Lanes4& l) : upper(u), lower(l) {}
  LATSCH_INLINE explicit Six(const double* p) : upper(lanes4(p)), lower(lanes4(p + 2)) {}
  LATSCH_INLINE void save(double* p) const {
    upper.save(p);
    lower.save(p + 2);
  }
  LATSCH_INLINE void add(double k, const Six& x) {
    upper += k * x.upper;
    lower += k * x.lower;
  }
  LATSCH_INLINE void subtract(double k, const Six& x) {
    upper -= k * x.upper;
    lower -= k * x.lower;
  }
};

/// Computes C <- C - A B.
LATSCH_INLINE void subtract_product(const double* A, const double* B, double* C) {
  const Six a[6] = {Six(A), Six(A + 6), Six(A + 12), Six(A + 18), Six(A + 24), Six(A + 30)};
  for (int j = 0; j < 36; j += 6) {
    Six c(C + j);
    for (int k = 0; k < 6; ++k) c.subtract(B[j + k], a[k]);
    c.save(C + j);
  }
}

/// Computes B <- A B.
LATSCH_INLINE void multiply_from_left(const double* A, double* B) {
  const Six a[6] = {Six(A), Six(A + 6), Six(A + 12), Six(A + 18), Six(A + 24), Six(A + 30)};
  for (int j = 0; j < 36; j += 6) {
    Six c(B[j] * a[0].upper, B[j] * a[0].lower);
    for (int k = 1; k < 6; ++k) c.add(B[j + k], a[k]);
    c.save(B + j);
  }
}

/// Computes y = A x.
LATSCH_INLINE void multiply(const double* A, const double* x, double* y) {
  const Six first(A);
  Six even(x[0] * first.upper, x[0] * first.lower), odd(0.0, 0.0);
  odd.add(x[1], Six(A + 6));
  for (int k = 2; k < 6; k += 2) {
    even.add(x[k], Six(A + 6 * k));
    odd.add(x[k + 1], Six(A + 6 * k + 6));
  }
  Six(even.upper + odd.upper, even.lower + odd.lower).save(y);
}

/// Computes y <- y - A x.
LATSCH_INLINE void subtract_product_of(const double* A, const double* x, double* y) {
  Six even(y), odd(0.0, 0.0);
  for (int k = 0; k < 6; k += 2) {
    even.subtract(x[k], Six(A + 6 * k));
    odd.subtract(x[k + 1], Six(A + 6 * k + 6));
  }
  Six(even.upper + odd.upper, even.lower + odd.lower).save(y);
}

/// Masks for one column of six rows. In `kOthers` all bits are set in all rows but k; `kUnit` has
/// the number 1 in row k.
struct SixMask {
  double of[6];
};
inline constexpr double kSet = std::bit_cast<double>(~std::uint64_t{0});
inline constexpr SixMask kOthers[6] = {{{0.0, kSet, kSet, kSet, kSet, kSet}},
                                       {{kSet, 0.0, kSet, kSet, kSet, kSet}},
                                       {{kSet, kSet, 0.0, kSet, kSet, kSet}},
                                       {{kSet, kSet, kSet, 0.0, kSet, kSet}},
                                       {{kSet, kSet, kSet, kSet, 0.0, kSet}},
                                       {{kSet, kSet, kSet, kSet, kSet, 0.0}}};
inline constexpr SixMask kUnit[6] = {{{1.0}},
                                     {{0.0, 1.0}},
                                     {{0.0, 0.0, 1.0}},
                                     {{0.0, 0.0, 0.0, 1.0}},
                                     {{0.0, 0.0, 0.0, 0.0, 1.0}},
                                     {{0.0, 0.0, 0.0, 0.0, 0.0, 1.0}}};

/// Set row k of a column to 0, or to 1.
LATSCH_INLINE Six without_row(const Six& x, int k) {
  const Six others(kOthers[k].of);
  return {Lanes4::bit_and(x.upper, others.upper), Lanes4::bit_and(x.lower, others.lower)};
}
LATSCH_INLINE Six with_one_in_row(const Six& x, int k) {
  const Six unit(kUnit[k].of), left = without_row(x, k);
  return {Lanes4::bit_or(left.upper, unit.upper), Lanes4::bit_or(left.lower, unit.lower)};
}

/// Inverts A by Gauss-Jordan elimination in place of A', largest pivots first. Returns false if a
/// pivot is zero or not a number. Each row is stored in two halves and read in the same halves,
/// because the processor stalls if it reads a value in other pieces than it was stored.
LATSCH_INLINE bool invert(const double* A, double* x) {
  double m[6][8];
  int from[6];
  const auto row_at = [&](int i) { return Six(lanes4(m[i]), lanes4(m[i] + 4)); };
  const auto keep = [&](const Six& row, int i) {
    row.upper.save(m[i]);
    row.lower.save(m[i] + 4);
  };
  for (int i = 0; i < 6; ++i) keep(Six(A + 6 * i), i);
  for (int k = 0; k < 6; ++k) {
    const int column = k < 4 ? k : k + 2;
    int p = k;
    for (int i = k + 1; i < 6; ++i)
      if (__builtin_fabs(m[i][column]) > __builtin_fabs(m[p][column])) p = i;
    const double pivot = m[p][column];
    if (!(__builtin_fabs(pivot) > 0.0 && __builtin_fabs(pivot) <= __DBL_MAX__)) return false;
    from[k] = p;
    const Six largest = with_one_in_row(row_at(p), k);
    if (p != k) keep(row_at(k), p);
    const double inverse = 1.0 / pivot;
    const Six row(inverse * largest.upper, inverse * largest.lower);
    keep(row, k);
    for (int i = 0; i < 6; ++i) {
      if (i == k) continue;
      Six left = without_row(row_at(i), k);
      left.subtract(m[i][column], row);
      keep(left, i);
    }
  }
  for (int i = 0; i < 6; ++i) row_at(i).save(x + 6 * i);
  for (int k = 5; k >= 0; --k) {
    if (from[k] == k) continue;
    for (int i = 0; i < 36; i += 6) {
      const double kept = x[i + k];
      x[i + k] = x[i + from[k]];
      x[i + from[k]] = kept;
    }
  }
  return true;
}

/// Factorizes all blocks in the order of elimination. Returns -1, or the index of the body whose
/// diagonal block is singular.
int factorize(const EliminationPlan& of, double* blocks, double* pivots) {
  for (int i = 0; i < of.bodies; ++i) {
    const EliminatedBody& k = of.order[i];
    double* const pivot = pivots + 36 * k.body;
    if (!invert(blocks + 36 * k.body, pivot)) return k.body;
    for (int n = k.first_neighbor; n < k.end_of_neighbors; ++n)
      multiply_from_left(pivot, blocks + 36 * of.neighbors[n].right);
    for (int u = k.first_update; u < k.end_of_updates; ++u)
      subtract_product(blocks + 36 * of.updates[u].below,
                       blocks + 36 * of.updates[u].right,
                       blocks + 36 * of.updates[u].to);
  }
  return -1;
}

/// Solves the factorized system for one right-hand side.
void solve(const EliminationPlan& of, const double* blocks, const double* pivots, double* x) {
  for (int i = 0; i < of.bodies; ++i) {
    const EliminatedBody& k = of.order[i];
    double* const own = x + 6 * k.body;
    multiply(pivots + 36 * k.body, own, own);
    for (int n = k.first_neighbor; n < k.end_of_neighbors; ++n)
      subtract_product_of(blocks + 36 * of.neighbors[n].below, own, x + 6 * of.neighbors[n].body);
  }
  for (int i = of.bodies - 1; i >= 0; --i) {
    const EliminatedBody& k = of.order[i];
    for (int n = k.first_neighbor; n < k.end_of_neighbors; ++n)
      subtract_product_of(
          blocks + 36 * of.neighbors[n].right, x + 6 * of.neighbors[n].body, x + 6 * k.body);
  }
}

}  // namespace latsch::multibody::LATSCH_KERNELS
