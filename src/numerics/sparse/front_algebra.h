// SPDX-License-Identifier: Apache-2.0
// Dense products and solutions on a front of a sparse factor, in float and double, by BLAS and
// LAPACK, and by the kernels of front_kernels.h for small matrices in float. Matrices are
// column-major. L is the pivot block of the front's panel (a lower triangle), whose columns are
// `ld` numbers apart. One right-hand side uses matrix-vector functions, several use matrix
// products.
#pragma once

namespace latsch::numerics {

/// Computes L of A = L L' in place in the lower triangle [n x n]. Returns false if A is not
/// positive definite.
template <class Real>
bool cholesky(int n, Real* A, int ld);

/// Compute P A = L U in place [n x n] by partial pivoting, and x <- A^-1 x by this factorization.
/// `rows` holds the permutation P, n numbers.
void factorize_lu(int n, float* A, int* rows);
void solve_lu(int n, const float* LU, const int* rows, float* x);

/// Computes B <- B L^-T, B [rows x n] with the same ld.
template <class Real>
void solve_right_transposed(int rows, int n, const Real* L, int ld, Real* B);

/// Computes C <- -B B', the lower triangle; C [rows x rows] compact, B [rows x n].
template <class Real>
void negative_square(int rows, int n, const Real* B, int ld, Real* C);

// Specializations for float, which use the kernels of front_kernels.h where they are faster.
template <>
bool cholesky(int n, float* A, int ld);
template <>
void solve_right_transposed(int rows, int n, const float* L, int ld, float* B);
template <>
void negative_square(int rows, int n, const float* B, int ld, float* C);

/// Compute X <- L^-1 X and X <- L^-T X for X [n x columns], whose columns are `ldx` numbers apart.
template <class Real>
void solve_lower(int n, int columns, const Real* L, int ld, Real* X, int ldx);
template <class Real>
void solve_lower_transposed(int n, int columns, const Real* L, int ld, Real* X, int ldx);

/// Computes Y = B X; B [rows x n], X [n x columns], Y [rows x columns] compact.
template <class Real>
void multiply(int rows, int columns, int n, const Real* B, int ld, const Real* X, int ldx, Real* Y);

/// Computes X <- X - B' Y; B [rows x n], Y [rows x columns] compact, X [n x columns].
template <class Real>
void subtract_transposed(
    int n, int columns, int rows, const Real* B, int ld, const Real* Y, Real* X, int ldx);

}  // namespace latsch::numerics
