// SPDX-License-Identifier: Apache-2.0
#include "numerics/dense/cholesky.h"

#include <gtest/gtest.h>

namespace latsch::numerics {
namespace {

/// Returns the matrix min(i, j), whose factor is the lower triangle of ones.
Eigen::MatrixXd smaller_index(int n) {
  return Eigen::MatrixXd::NullaryExpr(n, n, [](Eigen::Index i, Eigen::Index j) {
    return 1.0 + static_cast<double>(std::min(i, j));
  });
}

TEST(Cholesky, FactorsTheMatrixOfTheSmallerIndex) {
  const Cholesky factors(smaller_index(5));
  ASSERT_TRUE(factors.is_positive_definite());
  EXPECT_NEAR(factors.log_determinant(), 0.0, 1e-15);
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 5; ++j) EXPECT_EQ(factors.L()(i, j), j <= i ? 1.0 : 0.0);
  }
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(5, 1.0, 5.0);
  // L^-1 takes differences of successive entries.
  EXPECT_EQ(factors.solve_lower(b), Eigen::VectorXd::Ones(5));
  EXPECT_EQ(factors.solve_lower(Eigen::MatrixXd(b)).col(0), Eigen::VectorXd::Ones(5));
  EXPECT_EQ(factors.solve_upper(b), (Eigen::VectorXd(5) << -1, -1, -1, -1, 5).finished());
  EXPECT_EQ(factors.solve(b), Eigen::VectorXd::Unit(5, 4));
}

TEST(Cholesky, SaysWhereAMatrixIsIndefinite) {
  EXPECT_FALSE(Cholesky((Eigen::Matrix2d() << 1, 2, 2, 1).finished()).is_positive_definite());
}

TEST(PivotedCholesky, SolvesWithDefiniteIndefiniteAndSingularMatrices) {
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(5, 1.0, 5.0);
  const PivotedCholesky definite(smaller_index(5));
  EXPECT_LT((definite.solve(b) - Eigen::VectorXd::Unit(5, 4)).norm(), 1e-14);
  EXPECT_LT((definite.solve(Eigen::MatrixXd(b)) - Eigen::VectorXd::Unit(5, 4)).norm(), 1e-14);
  const PivotedCholesky indefinite((Eigen::Matrix2d() << 1, 2, 2, 1).finished());
  const Eigen::VectorXd three = Eigen::VectorXd::Constant(2, 3.0);
  EXPECT_LT((indefinite.solve(three) - Eigen::VectorXd::Ones(2)).norm(), 1e-15);
  const Eigen::MatrixXd singular = Eigen::MatrixXd::Ones(2, 2);
  EXPECT_LT((singular * PivotedCholesky(singular).solve(three) - three).norm(), 1e-15);
}

}  // namespace
}  // namespace latsch::numerics
