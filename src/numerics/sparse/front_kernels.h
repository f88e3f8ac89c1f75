// SPDX-License-Identifier: Apache-2.0
// Triangles and products of a front with few pivots, in single precision. For these BLAS spends
// more time packing and dividing than multiplying. Registers hold eight rows of a column; up to six
// columns by sixteen rows of a result stay in registers. Every number is a sum in the order of the
// pivots. Included once per kernel set, by front_algebra.cpp.
#include "numerics/sparse/eight_floats.h"

namespace latsch::numerics::LATSCH_KERNELS {

/// Returns a - b c.
inline __attribute__((always_inline)) EightFloats less_product(EightFloats a,
                                                               float b,
                                                               EightFloats c) {
#if LATSCH_KERNEL_WIDTH > 2
  return (EightFloats)_mm256_fnmadd_ps(_mm256_set1_ps(b), (__m256)c, (__m256)a);
#else
  return a - b * c;
#endif
}

/// Access to the first `count` of eight rows. Numbers beyond them are neither read nor written.
struct Rows {
  int count;
#if LATSCH_KERNEL_WIDTH > 2
  __m256i mask;
  explicit Rows(int n)
      : count(n < 8 ? n : 8),
        mask(_mm256_cmpgt_epi32(_mm256_set1_epi32(n), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7))) {}
#else
  explicit Rows(int n) : count(n < 8 ? n : 8) {}
#endif
  inline __attribute__((always_inline)) EightFloats load(const float* from) const {
#if LATSCH_KERNEL_WIDTH > 2
    return (EightFloats)_mm256_maskload_ps(from, mask);
#else
    EightFloats v{};
    for (int r = 0; r < count; ++r) v[r] = from[r];
    return v;
#endif
  }
  inline __attribute__((always_inline)) void store(EightFloats v, float* to) const {
#if LATSCH_KERNEL_WIDTH > 2
    _mm256_maskstore_ps(to, mask, (__m256)v);
#else
    for (int r = 0; r < count; ++r) to[r] = v[r];
#endif
  }
};

/// Access to all eight rows.
struct EightRows {
  inline __attribute__((always_inline)) EightFloats load(const float* from) const {
    return *reinterpret_cast<const EightFloats*>(from);
  }
  inline __attribute__((always_inline)) void store(EightFloats v, float* to) const {
    *reinterpret_cast<EightFloats*>(to) = v;
  }
};

/// Computes sum <- sum - B_r L_c' over the first n columns, for `registers` times eight rows of B
/// and `width` rows of L. Successive columns of B and of L are `ld` numbers apart.
template <int width, int registers, class Some>
inline __attribute__((always_inline)) void subtract_products(int n,
                                                             const float* L,
                                                             const float* B,
                                                             int ld,
                                                             Some rows,
                                                             EightFloats (&sum)[width][registers]) {
  for (int k = 0; k < n; ++k, L += ld, B += ld) {
    EightFloats b[registers];
    for (int r = 0; r < registers; ++r) b[r] = rows.load(B + 8 * r);
    for (int c = 0; c < width; ++c) {
      for (int r = 0; r < registers; ++r) sum[c][r] = less_product(sum[c][r], L[c], b[r]);
    }
  }
}

/// Computes the columns j ... j + width - 1 of B <- B L^-T from the preceding columns.
template <int width, int registers, class Some>
inline __attribute__((always_inline)) void solve_columns(
    int j, const float* L, const float* inverse, int ld, float* B, Some rows) {
  EightFloats x[width][registers];
  const std::size_t first = static_cast<std::size_t>(j) * ld;
  for (int c = 0; c < width; ++c) {
    for (int r = 0; r < registers; ++r)
      x[c][r] = rows.load(B + first + static_cast<std::size_t>(c) * ld + 8 * r);
  }
  subtract_products<width, registers>(j, L + j, B, ld, rows, x);
  for (int c = 0; c < width; ++c) {
    for (int m = 0; m < c; ++m) {
      const float l = L[first + static_cast<std::size_t>(m) * ld + j + c];
      for (int r = 0; r < registers; ++r) x[c][r] = less_product(x[c][r], l, x[m][r]);
    }
    for (int r = 0; r < registers; ++r) {
      x[c][r] = x[c][r] * inverse[j + c];
      rows.store(x[c][r], B + first + static_cast<std::size_t>(c) * ld + 8 * r);
    }
  }
}

template <int registers, class Some>
inline __attribute__((always_inline)) void solve_rows(
    int n, const float* L, const float* inverse, int ld, float* B, Some rows) {
  int j = 0;
  for (; j + 6 <= n; j += 6) solve_columns<6, registers>(j, L, inverse, ld, B, rows);
  for (; j + 3 <= n; j += 3) solve_columns<3, registers>(j, L, inverse, ld, B, rows);
  for (; j < n; ++j) solve_columns<1, registers>(j, L, inverse, ld, B, rows);
}

/// Computes B <- B L^-T. `inverse` holds the inverses of L's diagonal.
void solve_right(int rows, int n, const float* L, const float* inverse, int ld, float* B) {
  int i = 0;
  for (; i + 16 <= rows; i += 16) solve_rows<2>(n, L, inverse, ld, B + i, EightRows{});
  for (; i < rows; i += 8) solve_rows<1>(n, L, inverse, ld, B + i, Rows(rows - i));
}

/// Computes the columns j ... j + width - 1 of the factor's triangle from the preceding columns.
/// Returns false if a pivot is not positive.
template <int width>
inline __attribute__((always_inline)) bool factorize_columns(
    int j, int n, float* A, float* inverse, int ld) {
  float* own = A + static_cast<std::size_t>(j) * ld;
  for (int i = j; i < n; i += 8) {
    const Rows rows(n - i);
    EightFloats x[width][1];
    for (int c = 0; c < width; ++c) x[c][0] = rows.load(own + static_cast<std::size_t>(c) * ld + i);
    subtract_products<width, 1>(j, A + j, A + i, ld, rows, x);
    for (int c = 0; c < width; ++c) rows.store(x[c][0], own + static_cast<std::size_t>(c) * ld + i);
  }
  for (int c = 0; c < width; ++c) {
    float* column = own + static_cast<std::size_t>(c) * ld;
    for (int m = 0; m < c; ++m) {
      const float* before = own + static_cast<std::size_t>(m) * ld;
      for (int i = j + c; i < n; ++i) column[i] -= before[j + c] * before[i];
    }
    const float pivot = column[j + c];
    if (!(pivot > 0.0f)) return false;
    column[j + c] = __builtin_sqrtf(pivot);
    inverse[j + c] = 1.0f / column[j + c];
    for (int i = j + c + 1; i < n; ++i) column[i] *= inverse[j + c];
  }
  return true;
}

/// Computes L of A = L L' in place in the lower triangle, and the inverses of its diagonal. The
/// upper triangle is overwritten by intermediate sums.
bool factorize(int n, float* A, float* inverse, int ld) {
  int j = 0;
  for (; j + 6 <= n; j += 6)
    if (!factorize_columns<6>(j, n, A, inverse, ld)) return false;
  for (; j + 3 <= n; j += 3)
    if (!factorize_columns<3>(j, n, A, inverse, ld)) return false;
  for (; j < n; ++j)
    if (!factorize_columns<1>(j, n, A, inverse, ld)) return false;
  return true;
}

/// Computes the columns j ... j + width - 1 of the lower triangle of C <- -B B'.
template <int width, int registers, class Some>
inline __attribute__((always_inline)) void square_columns(
    int j, int n, const float* B, int ld, int i, Some rows, float* C, int ldc) {
  EightFloats sum[width][registers]{};
  subtract_products<width, registers>(n, B + j, B + i, ld, rows, sum);
  for (int c = 0; c < width; ++c) {
    for (int r = 0; r < registers; ++r)
      rows.store(sum[c][r], C + static_cast<std::size_t>(j + c) * ldc + i + 8 * r);
  }
}

template <int registers, class Some>
inline __attribute__((always_inline)) void square_rows(
    int i, int end, int n, const float* B, int ld, Some rows, float* C, int ldc) {
  int j = 0;
  for (; j + 6 <= end; j += 6) square_columns<6, registers>(j, n, B, ld, i, rows, C, ldc);
  for (; j + 3 <= end; j += 3) square_columns<3, registers>(j, n, B, ld, i, rows, C, ldc);
  for (; j < end; ++j) square_columns<1, registers>(j, n, B, ld, i, rows, C, ldc);
}

/// Computes C <- -B B', the lower triangle; C compact. The upper triangle is overwritten.
void negative_square(int rows, int n, const float* B, int ld, float* C) {
  int i = 0;
  for (; i + 16 <= rows; i += 16) square_rows<2>(i, i + 16, n, B, ld, EightRows{}, C, rows);
  for (; i < rows; i += 8) {
    const Rows some(rows - i);
    square_rows<1>(i, i + some.count, n, B, ld, some, C, rows);
  }
}

}  // namespace latsch::numerics::LATSCH_KERNELS
