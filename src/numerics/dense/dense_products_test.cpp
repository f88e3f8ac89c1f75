// SPDX-License-Identifier: Apache-2.0
#include "numerics/dense/dense_products.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "numerics/sparse/front_algebra.h"

namespace latsch::numerics {
namespace {

template <class Scalar>
void expect_products_of_eigen() {
  using Matrix = DenseMatrix<Scalar>;
  const Matrix A = Matrix::Random(50, 9), B = Matrix::Random(50, 4), S = Matrix::Random(5, 4);
  const Matrix C = overlaps<Scalar>(A.middleCols(2, 5), B);
  EXPECT_LT((C - A.middleCols(2, 5).adjoint() * B).norm(), 1e-13);
  Matrix D = B;
  add_product<Scalar>(Scalar(-2.0), A.middleCols(1, 5), S, Scalar(0.5), D);
  EXPECT_LT((D - (0.5 * B - 2.0 * A.middleCols(1, 5) * S)).norm(), 1e-13);
  EXPECT_EQ(overlaps<Scalar>(A.leftCols(0), B).rows(), 0);
  add_product<Scalar>(Scalar(1.0), A.leftCols(0), Matrix(0, 4), Scalar(1.0), D);
}

TEST(DenseProducts, AreThoseOfEigen) {
  expect_products_of_eigen<double>();
  expect_products_of_eigen<std::complex<double>>();
}

// Two threads multiply small matrices, so that calls of both often overlap. Without the lock of
// blas_core.h they would overwrite each other's buffers.
TEST(DenseProducts, AreTheSameBitsInSeveralThreads) {
  constexpr int n = 24, kTimes = 40000, kThreads = 2;
  const Eigen::MatrixXd A = Eigen::MatrixXd::Random(n, n);
  const Eigen::MatrixXd spd = A * A.transpose() + n * Eigen::MatrixXd::Identity(n, n);
  const auto work = [&] {
    Eigen::MatrixXd C = overlaps<double>(A, A), L = spd, S = Eigen::MatrixXd::Zero(n, n);
    EXPECT_TRUE(cholesky(n, L.data(), n));
    solve_right_transposed(n, n, L.data(), n, C.data());
    negative_square(n, n, C.data(), n, S.data());
    return S;
  };
  const Eigen::MatrixXd alone = work();
  std::atomic<int> different = 0;
  std::vector<std::jthread> threads;
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([&] {
      for (int k = 0; k < kTimes; ++k) different += work() != alone;
    });
  }
  threads.clear();
  EXPECT_EQ(different, 0);
}

}  // namespace
}  // namespace latsch::numerics
