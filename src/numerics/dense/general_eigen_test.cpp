// SPDX-License-Identifier: Apache-2.0
#include "numerics/dense/general_eigen.h"

#include <gtest/gtest.h>

#include <limits>

namespace latsch::numerics {
namespace {

// The companion matrix of (x - 1)(x + 2)(x² - 2 x + 5) has the eigenvalues 1, -2, 1 ± 2i.
TEST(GeneralEigen, OfACompanionMatrixAreTheRootsOfItsPolynomial) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(4, 4);
  A.topRightCorner(3, 3).setIdentity();
  A.row(3) << 10.0, -9.0, -1.0, 1.0;
  const auto found = general_eigen(A);
  ASSERT_TRUE(found);
  EXPECT_LT((A * found->vectors - found->vectors * found->values.asDiagonal()).norm(), 1e-13);
  for (const std::complex<double> root : {std::complex(1.0), {-2.0}, {1.0, 2.0}, {1.0, -2.0}})
    EXPECT_LT((found->values.array() - root).abs().minCoeff(), 1e-13) << root;
}

TEST(GeneralEigen, OfNumbersThatAreNoneThereAreNone) {
  EXPECT_FALSE(
      general_eigen(Eigen::MatrixXd::Constant(2, 2, std::numeric_limits<double>::quiet_NaN())));
}

}  // namespace
}  // namespace latsch::numerics
