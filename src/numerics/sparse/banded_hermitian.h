// SPDX-License-Identifier: Apache-2.0
// Hermitian matrix of small bandwidth, with Cholesky factorization (LAPACK zpbtrf, zpbtrs).
#pragma once

#include <Eigen/Core>
#include <complex>
#include <utility>

namespace latsch::numerics {

class BandedHermitian {
 public:
  using Complex = std::complex<double>;

  /// Makes a zero matrix with entries in |row - column| <= bandwidth.
  BandedHermitian(int size, int bandwidth);

  int size() const { return static_cast<int>(lower_.cols()); }
  int bandwidth() const { return static_cast<int>(lower_.rows()) - 1; }

  /// Returns an entry of the lower triangle, row >= column.
  Complex& operator()(int row, int column) { return lower_(row - column, column); }
  Complex operator()(int row, int column) const { return lower_(row - column, column); }
  void set_zero() { lower_.setZero(); }
  /// The storage: column j holds the entries (j, j), (j+1, j), ... downward.
  Eigen::MatrixXcd& lower() { return lower_; }
  const Eigen::MatrixXcd& lower() const { return lower_; }

  /// Computes Y = A X.
  void multiply(const Eigen::Ref<const Eigen::MatrixXcd>& X, Eigen::Ref<Eigen::MatrixXcd> Y) const;

 private:
  Eigen::MatrixXcd lower_;
};

/// Factorization A = L L*. Memory is reused for further matrices of the same size.
class BandedCholesky {
 public:
  /// Returns false if A is not positive definite; then there is no factor.
  bool factorize(const BandedHermitian& A);
  /// Computes X <- A^-1 X.
  void solve(Eigen::Ref<Eigen::MatrixXcd> X) const;

 private:
  Eigen::MatrixXcd factor_;
};

/// Hermitian matrix [A B; B* C] of a banded part A and a few full rows and columns at the end, for
/// unknowns that are coupled to many others, such as the motions of a rim. The border B, C may be
/// empty.
struct BorderedHermitian {
  BandedHermitian banded;   // A, m x m
  Eigen::MatrixXcd border;  // B, m x b
  Eigen::MatrixXcd corner;  // C, b x b, both triangles

  explicit BorderedHermitian(BandedHermitian A, int width = 0)
      : banded(std::move(A)),
        border(Eigen::MatrixXcd::Zero(banded.size(), width)),
        corner(Eigen::MatrixXcd::Zero(width, width)) {}

  int size() const { return banded.size() + static_cast<int>(corner.rows()); }
  /// Adds `factor` times a matrix of the same shape.
  void add(double factor, const BorderedHermitian& other);
  /// Computes Y = A X, where A is this matrix.
  void multiply(const Eigen::Ref<const Eigen::MatrixXcd>& X, Eigen::Ref<Eigen::MatrixXcd> Y) const;
};

/// Factorization by elimination of the banded part.
class BorderedCholesky {
 public:
  /// Returns false if the matrix is not positive definite; then there is no factor.
  bool factorize(const BorderedHermitian& A);
  /// Computes X <- A^-1 X.
  void solve(Eigen::Ref<Eigen::MatrixXcd> X) const;

 private:
  BandedCholesky banded_;
  Eigen::MatrixXcd border_, solved_;  // B, A^-1 B
  Eigen::MatrixXcd inverse_;          // inverse of C - B* A^-1 B
};

}  // namespace latsch::numerics
