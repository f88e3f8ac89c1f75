// SPDX-License-Identifier: Apache-2.0
#include "numerics/sparse/banded_hermitian.h"

#include <gtest/gtest.h>

namespace latsch::numerics {
namespace {

TEST(BandedHermitian, SolvesAndMultipliesAsDense) {
  const int n = 40, band = 7;
  BandedHermitian A(n, band);
  A.lower() = Eigen::MatrixXcd::Random(band + 1, n);
  for (int j = 0; j < n; ++j) A(j, j) = 20.0;
  Eigen::MatrixXcd D = Eigen::MatrixXcd::Zero(n, n);
  for (int j = 0; j < n; ++j) {
    for (int i = j; i < std::min(n, j + band + 1); ++i) {
      D(i, j) = A(i, j);
      D(j, i) = std::conj(A(i, j));
    }
  }
  const Eigen::MatrixXcd X = Eigen::MatrixXcd::Random(n, 3);
  Eigen::MatrixXcd Y(n, 3);
  A.multiply(X, Y);
  EXPECT_LT((Y - D * X).norm(), 1e-13 * Y.norm());
  BandedCholesky factor;
  ASSERT_TRUE(factor.factorize(A));
  factor.solve(Y);
  EXPECT_LT((Y - X).norm(), 1e-13 * X.norm());
  for (int j = 0; j < n; ++j) A(j, j) = 1.0;
  EXPECT_FALSE(factor.factorize(A));
}

}  // namespace
}  // namespace latsch::numerics
