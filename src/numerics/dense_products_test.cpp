// SPDX-License-Identifier: Apache-2.0
#include "numerics/dense_products.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace latsch::numerics
