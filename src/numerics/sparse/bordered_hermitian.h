// SPDX-License-Identifier: Apache-2.0
// Hermitian matrix [A B; B* C] of a banded part A and a few last rows and columns that are full,
// for unknowns that touch many others, such as the motions of a rim. The border may be empty.
#pragma once

#include <Eigen/Core>

#include "numerics/sparse/banded_hermitian.h"

namespace latsch::numerics {

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
  /// Computes Y = this X.
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
  Eigen::MatrixXcd inverse_;          // of C - B* A^-1 B
};

}  // namespace latsch::numerics
