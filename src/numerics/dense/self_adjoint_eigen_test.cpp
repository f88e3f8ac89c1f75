// SPDX-License-Identifier: Apache-2.0
#include "numerics/dense/self_adjoint_eigen.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace latsch::numerics {
namespace {

constexpr int kSize = 12;

double angle(int k) { return (k + 1) * std::numbers::pi / (kSize + 1); }

/// Returns a tridiagonal matrix with `middle` on the diagonal, `beside` above it and the conjugate
/// of `beside` below it.
template <class Scalar>
Eigen::Matrix<Scalar, -1, -1> tridiagonal(double middle, Scalar beside) {
  Eigen::Matrix<Scalar, -1, -1> A = Eigen::Matrix<Scalar, -1, -1>::Zero(kSize, kSize);
  for (int i = 0; i < kSize; ++i) {
    A(i, i) = middle;
    if (i > 0) A(i - 1, i) = beside;
    if (i > 0) A(i, i - 1) = Eigen::numext::conj(beside);
  }
  return A;
}

template <class Matrix>
void expect_pairs_of_second_differences(const Matrix& A) {
  const auto [values, V] = self_adjoint_eigen(A);
  for (int k = 0; k < kSize; ++k) {
    EXPECT_NEAR(values[k], 2.0 - 2.0 * std::cos(angle(k)), 1e-14);
    EXPECT_NEAR(V.col(k).norm(), 1.0, 1e-14);
    EXPECT_LT((A * V.col(k) - values[k] * V.col(k)).norm(), 1e-14);
  }
}

TEST(SelfAdjointEigen, FindsThoseOfSecondDifferences) {  // 2 - 2 cos(k pi / (n + 1))
  const Eigen::MatrixXd A = tridiagonal(2.0, -1.0);
  expect_pairs_of_second_differences(A);
  EXPECT_LT((self_adjoint_eigenvalues(A) - self_adjoint_eigen(A).values).norm(), 1e-14);
}

TEST(SelfAdjointEigen, FindsThemWhereTheCouplingsHaveAnyPhase) {
  expect_pairs_of_second_differences(tridiagonal(2.0, std::polar(1.0, 0.7)));
}

// A bar of linear finite elements with consistent mass, fixed at both ends, has the eigenvalues 6
// (1 - cos a) / (2 + cos a), a = k pi / (n + 1).
TEST(SelfAdjointEigen, FindsTheFrequenciesOfABar) {
  const Eigen::VectorXd lambda =
      generalized_eigenvalues(tridiagonal(2.0, -1.0), tridiagonal(4.0 / 6.0, 1.0 / 6.0));
  const Eigen::VectorXd hermitian = generalized_eigenvalues(
      tridiagonal(2.0, std::polar(1.0, 0.7)), tridiagonal(4.0 / 6.0, -std::polar(1.0 / 6.0, 0.7)));
  for (int k = 0; k < kSize; ++k) {
    const double c = std::cos(angle(k));
    EXPECT_NEAR(lambda[k], 6.0 * (1.0 - c) / (2.0 + c), 1e-13);
    EXPECT_NEAR(hermitian[k], lambda[k], 1e-13);
  }
}

}  // namespace
}  // namespace latsch::numerics
