// SPDX-License-Identifier: Apache-2.0
// Kernels for eight right-hand sides side by side: one register of single precision holds the eight
// values of an unknown. Each number of the factor is read once for all of them, and right-hand
// sides are never added to each other. Included once per kernel set, by columns_together.cpp.
#include "numerics/sparse/eight_floats.h"

namespace latsch::numerics::LATSCH_KERNELS {

using Doubles4 = double __attribute__((vector_size(32), aligned(8), may_alias));

/// Returns a + b c.
inline __attribute__((always_inline)) EightFloats mul_add(EightFloats a, float b, EightFloats c) {
#if LATSCH_KERNEL_WIDTH > 2
  return (EightFloats)_mm256_fmadd_ps(_mm256_set1_ps(b), (__m256)c, (__m256)a);
#else
  return a + b * c;
#endif
}

inline __attribute__((always_inline)) EightFloats mul_add(EightFloats a,
                                                          EightFloats b,
                                                          EightFloats c) {
#if LATSCH_KERNEL_WIDTH > 2
  return (EightFloats)_mm256_fmadd_ps((__m256)b, (__m256)c, (__m256)a);
#else
  return a + b * c;
#endif
}

inline __attribute__((always_inline)) Doubles4 mul_add(Doubles4 a, double b, Doubles4 c) {
#if LATSCH_KERNEL_WIDTH > 2
  return (Doubles4)_mm256_fmadd_pd(_mm256_set1_pd(b), (__m256d)c, (__m256d)a);
#else
  return a + b * c;
#endif
}

/// Prefetches the next entries of `width` columns, those after or before the current ones.
template <int width>
inline __attribute__((always_inline)) void fetch(const float* column, int ld) {
  for (int j = 0; j < width; ++j) __builtin_prefetch(column + static_cast<std::ptrdiff_t>(j) * ld);
}

/// Adds the sum over `width` columns of L_ij y_j to v_i, for rows first ... end-1.
template <int width>
inline __attribute__((always_inline)) void add_columns(
    const float* L, int ld, const EightFloats* y, int first, int end, EightFloats* v) {
  for (int i = first; i < end; ++i) {
    if (i % 16 == 0) fetch<width>(L + static_cast<size_t>(width) * ld + i, ld);
    EightFloats sum = v[i];
    for (int j = 0; j < width; ++j) sum = mul_add(sum, L[static_cast<size_t>(j) * ld + i], y[j]);
    v[i] = sum;
  }
}

/// Adds the sum of L_ij v_i over rows first ... end-1 to y_j, two rows at a time.
template <int width>
inline __attribute__((always_inline)) void add_rows(
    const float* L, int ld, const EightFloats* v, int first, int end, EightFloats* y) {
  EightFloats even[width], odd[width];
  for (int j = 0; j < width; ++j) {
    even[j] = y[j];
    odd[j] = EightFloats{};
  }
  int i = first;
  for (; i + 1 < end; i += 2) {
    if (i % 16 < 2) fetch<width>(L - static_cast<std::ptrdiff_t>(width) * ld + i, ld);
    const EightFloats a = v[i], b = v[i + 1];
    for (int j = 0; j < width; ++j) {
      const float* column = L + static_cast<size_t>(j) * ld + i;
      even[j] = mul_add(even[j], column[0], a);
      odd[j] = mul_add(odd[j], column[1], b);
    }
  }
  for (; i < end; ++i) {
    for (int j = 0; j < width; ++j) {
      even[j] = mul_add(even[j], L[static_cast<size_t>(j) * ld + i], v[i]);
    }
  }
  for (int j = 0; j < width; ++j) y[j] = even[j] + odd[j];
}

template <int width>
inline __attribute__((always_inline)) void eliminate(
    const float* L, int ld, int j, int rows, EightFloats* v) {
  EightFloats y[width];
  for (int k = 0; k < width; ++k) {
    const float* column = L + static_cast<size_t>(j + k) * ld;
    EightFloats x = v[j + k];
    for (int m = 0; m < k; ++m) {
      x = mul_add(x, L[static_cast<size_t>(j + m) * ld + j + k], y[m]);
    }
    x = x * (1.0f / column[j + k]);
    v[j + k] = x;
    y[k] = -x;
  }
  add_columns<width>(L + static_cast<size_t>(j) * ld, ld, y, j + width, rows, v);
}

template <int width>
inline __attribute__((always_inline)) void substitute(
    const float* L, int ld, int j, int rows, EightFloats* v) {
  EightFloats y[width];
  for (int k = 0; k < width; ++k) y[k] = -v[j + k];
  add_rows<width>(L + static_cast<size_t>(j) * ld, ld, v, j + width, rows, y);
  for (int k = width - 1; k >= 0; --k) {
    const float* column = L + static_cast<size_t>(j + k) * ld;
    for (int m = k + 1; m < width; ++m) y[k] = mul_add(y[k], column[j + m], v[j + m]);
    v[j + k] = y[k] * (-1.0f / column[j + k]);
  }
}

/// Eliminates with one right-hand side; a register holds rows. Numbers read beyond the last row
/// must be finite; results for them go to the eight spare numbers after v.
template <int width>
inline __attribute__((always_inline)) void eliminate_one(
    const float* L, int ld, int j, int rows, float* v) {
  L += static_cast<size_t>(j) * ld;
  float y[width];
  for (int k = 0; k < width; ++k) {
    double x = v[j + k];  // The triangle is summed in double, so that an unknown is rounded once.
    for (int m = 0; m < k; ++m) x += double{L[static_cast<size_t>(m) * ld + j + k]} * y[m];
    v[j + k] = static_cast<float>(x / L[static_cast<size_t>(k) * ld + j + k]);
    y[k] = -v[j + k];
  }
  for (int i = j + width; i < rows; i += 8) {
    fetch<width>(L + static_cast<size_t>(width) * ld + i, ld);
    EightFloats* to = reinterpret_cast<EightFloats*>(v + i);
    EightFloats sum{};  // The sum is added at once, so that v is rounded once.
    for (int k = 0; k < width; ++k) {
      const float* column = L + static_cast<size_t>(k) * ld + i;
      sum = mul_add(sum, y[k], *reinterpret_cast<const EightFloats*>(column));
    }
    *to = *to + sum;
  }
}

/// Computes x <- L^-T (x - B' b) for one right-hand side; the spare numbers after v must be zero.
template <int width>
inline __attribute__((always_inline)) void substitute_one(
    const float* L, int ld, int j, int rows, float* v) {
  L += static_cast<size_t>(j) * ld;
  EightFloats sums[width];
  for (int k = 0; k < width; ++k) sums[k] = EightFloats{};
  for (int i = j + width; i < rows; i += 8) {
    fetch<width>(L - static_cast<std::ptrdiff_t>(width) * ld + i, ld);
    const EightFloats x = *reinterpret_cast<const EightFloats*>(v + i);
    for (int k = 0; k < width; ++k) {
      const float* column = L + static_cast<size_t>(k) * ld + i;
      sums[k] = mul_add(sums[k], *reinterpret_cast<const EightFloats*>(column), x);
    }
  }
  for (int k = width - 1; k >= 0; --k) {
    const EightFloats& s = sums[k];
    const float* column = L + static_cast<size_t>(k) * ld + j;
    double x = v[j + k];
    x -= ((s[0] + s[4]) + (s[1] + s[5])) + ((s[2] + s[6]) + (s[3] + s[7]));
    for (int m = k + 1; m < width; ++m) x -= double{column[m]} * v[j + m];
    v[j + k] = static_cast<float>(x / column[k]);
  }
}

void forward_one(int pivots, int rows, const float* L, float* v) {
  int j = 0;
  for (; j + 8 <= pivots; j += 8) eliminate_one<8>(L, rows, j, rows, v);
  for (; j + 3 <= pivots; j += 3) eliminate_one<3>(L, rows, j, rows, v);
  for (; j < pivots; ++j) eliminate_one<1>(L, rows, j, rows, v);
}

void backward_one(int pivots, int rows, const float* L, float* v) {
  int j = pivots;
  const int rest = pivots % 8;
  for (; j % 8 != 0 && (rest - (pivots - j)) % 3 != 0; --j)
    substitute_one<1>(L, rows, j - 1, rows, v);
  for (; j % 8 != 0; j -= 3) substitute_one<3>(L, rows, j - 3, rows, v);
  for (; j > 0; j -= 8) substitute_one<8>(L, rows, j - 8, rows, v);
}

void forward(int pivots, int rows, const float* L, float* columns) {
  EightFloats* v = reinterpret_cast<EightFloats*>(columns);
  int j = 0;
  for (; j + 4 <= pivots; j += 4) eliminate<4>(L, rows, j, rows, v);
  for (; j < pivots; ++j) eliminate<1>(L, rows, j, rows, v);
}

void backward(int pivots, int rows, const float* L, float* columns) {
  EightFloats* v = reinterpret_cast<EightFloats*>(columns);
  int j = pivots;
  for (; j % 4 != 0; --j) substitute<1>(L, rows, j - 1, rows, v);
  for (; j > 0; j -= 4) substitute<4>(L, rows, j - 4, rows, v);
}

void multiply(int block_rows,
              const int* start,
              const int* column,
              const double* values,
              const double* X,
              double* Y) {
  const Doubles4* x = reinterpret_cast<const Doubles4*>(X);
  Doubles4* y = reinterpret_cast<Doubles4*>(Y);
  for (int i = 0; i < block_rows; ++i) {
    const Doubles4 x0 = x[3 * i], x1 = x[3 * i + 1], x2 = x[3 * i + 2];
    Doubles4 y0{}, y1{}, y2{};
    const int diagonal = start[i + 1] - 1;
    for (int k = start[i]; k <= diagonal; ++k) {
      const double* b = values + 9 * k;
      const int j = 3 * column[k];
      for (int c = 0; c < 3; ++c) {
        const Doubles4 xj = x[j + c];
        y0 = mul_add(y0, b[3 * c], xj);
        y1 = mul_add(y1, b[3 * c + 1], xj);
        y2 = mul_add(y2, b[3 * c + 2], xj);
        if (k == diagonal) continue;
        Doubles4 sum = y[j + c];
        sum = mul_add(sum, b[3 * c], x0);
        sum = mul_add(sum, b[3 * c + 1], x1);
        y[j + c] = mul_add(sum, b[3 * c + 2], x2);
      }
    }
    /// Later rows of the loop add to this result.
    y[3 * i] = y0;
    y[3 * i + 1] = y1;
    y[3 * i + 2] = y2;
  }
}

}  // namespace latsch::numerics::LATSCH_KERNELS
