// SPDX-License-Identifier: Apache-2.0
#include "numerics/dense/lu.h"

#include <gtest/gtest.h>

namespace latsch::numerics {
namespace {

// The matrix, a cyclic permutation times a triangle of ones, needs pivoting because its first
// pivots are zero.
TEST(Lu, SolvesWherePivotsVanish) {
  constexpr int n = 7;
  const Eigen::MatrixXd A = Eigen::MatrixXd::NullaryExpr(
      n, n, [](Eigen::Index i, Eigen::Index j) { return j >= (i + 3) % n ? 1.0 : 0.0; });
  const Eigen::MatrixXd x = Eigen::MatrixXd::NullaryExpr(
      n, 3, [](Eigen::Index i, Eigen::Index j) { return static_cast<double>(1 + i * i - 4 * j); });
  Lu lu;
  lu.factorize(A);
  Eigen::MatrixXd found = A * x;
  lu.solve(found);
  EXPECT_LT((found - x).cwiseAbs().maxCoeff(), 1e-12);
}

}  // namespace
}  // namespace latsch::numerics
