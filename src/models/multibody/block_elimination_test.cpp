// SPDX-License-Identifier: Apache-2.0
#include "models/multibody/block_elimination.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "numerics/kernels/kernel_set.h"

namespace latsch::multibody {
namespace {

using Pairs = std::vector<std::pair<int, int>>;

/// Compares solutions with Eigen's dense LU factorization, an independent program, for bodies that
/// form a tree, a closed loop and two separate parts. The rows of the diagonal blocks are permuted,
/// so that these blocks need pivoting.
void solves_like_a_dense_factorization() {
  RandomStream random(11, 1);
  for (const Pairs& pairs : {Pairs{{0, 1}, {1, 2}, {1, 3}, {0, 4}},
                             Pairs{{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 0}, {4, 0}},
                             Pairs{{0, 1}, {3, 4}}}) {
    BlockElimination A(5, pairs);
    A.clear();
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(30, 30);
    const auto fill = [&](int i, int j) {
      Matrix6d& block = A.block(i, j);
      for (double& x : block.reshaped()) x = random.uniform() - 0.5;
      if (i == j)
        for (int row = 0; row < 6; ++row) block(row, (row + i) % 6) += 5.0;
      dense.block<6, 6>(6 * i, 6 * j) = block;
    };
    for (int i = 0; i < 5; ++i) fill(i, i);
    for (const auto& [i, j] : pairs) fill(i, j), fill(j, i);
    Eigen::MatrixXd b(30, 3);
    for (double& x : b.reshaped()) x = random.uniform();
    ASSERT_TRUE(A.factorize());
    Eigen::MatrixXd x = b, y = b;
    A.solve(x);
    A.solve_transposed(y);
    EXPECT_LT((dense * x - b).norm(), 1e-13 * b.norm());
    EXPECT_LT((dense.transpose() * y - b).norm(), 1e-13 * b.norm());
    const Eigen::MatrixXd inverse = dense.inverse();
    for (int i = 0; i < 5; ++i)
      for (int j = 0; j < 5; ++j)
        EXPECT_LT((A.inverse_block(i, j) - inverse.block<6, 6>(6 * i, 6 * j)).norm(),
                  1e-13 * inverse.norm());
  }
}

TEST(BlockElimination, SolvesLikeADenseFactorization) {
  for (const KernelSet set : kernel_sets()) {
    const WithKernelSet with(set);
    solves_like_a_dense_factorization();
  }
}

TEST(BlockElimination, NamesTheBodyWhosePivotIsNoNumber) {
  BlockElimination A(2, {{0, 1}});
  A.clear();
  A.block(0, 0).setIdentity();
  A.block(1, 1).setIdentity();
  A.block(1, 1)(0, 5) = NAN;
  EXPECT_FALSE(A.factorize());
  EXPECT_EQ(A.singular_body(), 1);
}

TEST(BlockElimination, NamesTheBodyWithoutSupport) {
  BlockElimination A(2, {{0, 1}});
  A.clear();
  A.block(0, 0).setIdentity();
  EXPECT_FALSE(A.factorize());
  EXPECT_EQ(A.singular_body(), 1);
}

}  // namespace
}  // namespace latsch::multibody
