// SPDX-License-Identifier: Apache-2.0
#include "numerics/sparse/front_algebra.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "numerics/dense/blas_core.h"
#include "numerics/dense/blas_functions.h"

#define LATSCH_KERNELS_IN "numerics/sparse/front_kernels.h"
#include "numerics/kernels/for_each_kernel_set.h"

namespace latsch::numerics {
namespace {

/// Largest number of columns of a triangle, and of rows of a product, for which the kernels of
/// front_kernels.h are faster than BLAS.
constexpr int kFewColumns = 96, kFewRows = 512;

/// Returns the column at which a large triangle is divided into two. It is a multiple of six,
/// because the kernels work on six columns at a time.
int half(int n) { return (n / 2 + 5) / 6 * 6; }

/// Computes C <- C - A B' for C [rows x columns] and A [rows x n]. Successive columns of every
/// matrix are `ld` numbers apart.
void subtract_product(
    int rows, int columns, int n, const float* A, const float* B, int ld, float* C) {
  const BlasTurn turn;
  const float minus = -1.0f, one = 1.0f;
  gemm(float())("N", "T", &rows, &columns, &n, &minus, A, &ld, B, &ld, &one, C, &ld, 1, 1);
}

/// Computes the lower triangle of C <- C - A A', C [rows x rows].
void subtract_square(int rows, int n, const float* A, int ld, float* C) {
  const BlasTurn turn;
  const float minus = -1.0f, one = 1.0f;
  syrk(float())("L", "N", &rows, &n, &minus, A, &ld, &one, C, &ld, 1, 1);
}

/// Computes X <- op(L)^-1 X, op "N" or "T" (transposed).
template <class Real>
void solve(const char* op, int n, int columns, const Real* L, int ld, Real* X, int ldx) {
  const BlasTurn turn;
  const Real one = 1;
  const int next = 1;
  if (columns == 1) {
    trsv(Real())("L", op, "N", &n, L, &ld, X, &next, 1, 1, 1);
  } else {
    trsm(Real())("L", "L", op, "N", &n, &columns, &one, L, &ld, X, &ldx, 1, 1, 1, 1);
  }
}

}  // namespace

template <class Real>
bool cholesky(int n, Real* A, int ld) {
  const BlasTurn turn;
  int info = 0;
  potrf(Real())("L", &n, A, &ld, &info, 1);
  return info == 0;
}

/// Factorizes by recursive halving: BLAS computes the products, and only short triangles are left
/// for the kernels.
template <>
bool cholesky(int n, float* A, int ld) {
  if (n <= kFewColumns) {
    std::array<float, kFewColumns> inverse;
    return LATSCH_KERNEL(factorize)(n, A, inverse.data(), ld);
  }
  const int first = half(n), rest = n - first;
  float* below = A + first;
  float* corner = below + static_cast<std::size_t>(first) * ld;
  if (!cholesky(first, A, ld)) return false;
  solve_right_transposed(rest, first, A, ld, below);
  subtract_square(rest, first, below, ld, corner);
  return cholesky(rest, corner, ld);
}

void factorize_lu(int n, float* A, int* rows) {
  const BlasTurn turn;
  int info = 0;
  sgetrf_(&n, &n, A, &n, rows, &info);
}

void solve_lu(int n, const float* LU, const int* rows, float* x) {
  const BlasTurn turn;
  const int one = 1;
  int info = 0;
  sgetrs_("N", &n, &one, LU, &n, rows, x, &n, &info, 1);
}

template <class Real>
void solve_right_transposed(int rows, int n, const Real* L, int ld, Real* B) {
  const BlasTurn turn;
  const Real one = 1;
  trsm(Real())("R", "L", "T", "N", &rows, &n, &one, L, &ld, B, &ld, 1, 1, 1, 1);
}

template <>
void solve_right_transposed(int rows, int n, const float* L, int ld, float* B) {
  if (n <= kFewColumns) {
    std::array<float, kFewColumns> inverse;
    for (int j = 0; j < n; ++j) inverse[j] = 1.0f / L[static_cast<std::size_t>(j) * ld + j];
    return LATSCH_KERNEL(solve_right)(rows, n, L, inverse.data(), ld, B);
  }
  const int first = half(n), rest = n - first;
  float* others = B + static_cast<std::size_t>(first) * ld;
  solve_right_transposed(rows, first, L, ld, B);
  subtract_product(rows, rest, first, B, L + first, ld, others);
  solve_right_transposed(rows, rest, L + static_cast<std::size_t>(first) * ld + first, ld, others);
}

template <class Real>
void negative_square(int rows, int n, const Real* B, int ld, Real* C) {
  const BlasTurn turn;
  const Real minus = -1, zero = 0;
  syrk(Real())("L", "N", &rows, &n, &minus, B, &ld, &zero, C, &rows, 1, 1);
}

template <>
void negative_square(int rows, int n, const float* B, int ld, float* C) {
  if (rows <= kFewRows && n <= kFewColumns)
    return LATSCH_KERNEL(negative_square)(rows, n, B, ld, C);
  const BlasTurn turn;
  const float minus = -1.0f, zero = 0.0f;
  syrk(float())("L", "N", &rows, &n, &minus, B, &ld, &zero, C, &rows, 1, 1);
}

template <class Real>
void solve_lower(int n, int columns, const Real* L, int ld, Real* X, int ldx) {
  solve("N", n, columns, L, ld, X, ldx);
}

template <class Real>
void solve_lower_transposed(int n, int columns, const Real* L, int ld, Real* X, int ldx) {
  solve("T", n, columns, L, ld, X, ldx);
}

template <class Real>
void multiply(
    int rows, int columns, int n, const Real* B, int ld, const Real* X, int ldx, Real* Y) {
  const BlasTurn turn;
  const Real one = 1, zero = 0;
  const int next = 1;
  if (columns == 1) {
    gemv(Real())("N", &rows, &n, &one, B, &ld, X, &next, &zero, Y, &next, 1);
  } else {
    gemm(Real())("N", "N", &rows, &columns, &n, &one, B, &ld, X, &ldx, &zero, Y, &rows, 1, 1);
  }
}

template <class Real>
void subtract_transposed(
    int n, int columns, int rows, const Real* B, int ld, const Real* Y, Real* X, int ldx) {
  const BlasTurn turn;
  const Real one = 1, minus = -1;
  const int next = 1;
  if (columns == 1) {
    gemv(Real())("T", &rows, &n, &minus, B, &ld, Y, &next, &one, X, &next, 1);
  } else {
    gemm(Real())("T", "N", &n, &columns, &rows, &minus, B, &ld, Y, &rows, &one, X, &ldx, 1, 1);
  }
}

template void solve_lower(int, int, const float*, int, float*, int);
template void solve_lower_transposed(int, int, const float*, int, float*, int);
template void multiply(int, int, int, const float*, int, const float*, int, float*);
template void subtract_transposed(int, int, int, const float*, int, const float*, float*, int);
template bool cholesky(int, double*, int);
template void solve_right_transposed(int, int, const double*, int, double*);
template void negative_square(int, int, const double*, int, double*);
template void solve_lower(int, int, const double*, int, double*, int);
template void solve_lower_transposed(int, int, const double*, int, double*, int);
template void multiply(int, int, int, const double*, int, const double*, int, double*);
template void subtract_transposed(int, int, int, const double*, int, const double*, double*, int);

}  // namespace latsch::numerics
