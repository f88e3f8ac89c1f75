// SPDX-License-Identifier: Apache-2.0
// Hermitian matrix of small bandwidth, with Cholesky factorization (LAPACK zpbtrf, zpbtrs).
#pragma once

#include <Eigen/Core>
#include <complex>

namespace latsch::numerics {

class BandedHermitian {
 public:
  using Complex = std::complex<double>;

  /// Makes a zero matrix with entries in |row - column| <= bandwidth.
  BandedHermitian(int size, int bandwidth);

  int size() const { return static_cast<int>(lower_.cols()); }
  int bandwidth() const { return static_cast<int>(lower_.rows()) - 1; }

  /// Entry of the lower triangle, row >= column.
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

}  // namespace latsch::numerics
