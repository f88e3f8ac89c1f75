// SPDX-License-Identifier: Apache-2.0
#include "numerics/sparse/symmetric_matrix.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "numerics/sparse/lattice_testing.h"

namespace latsch::numerics {
namespace {

/// Returns the sum of the element matrices as a dense matrix, assembled entry by entry.
Eigen::MatrixXd assemble_dense(int size,
                               const std::vector<std::vector<int>>& elements,
                               const std::vector<Eigen::MatrixXd>& K) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(size, size);
  for (size_t e = 0; e < elements.size(); ++e) {
    for (size_t a = 0; a < elements[e].size(); ++a) {
      for (size_t b = 0; b < elements[e].size(); ++b) {
        if (elements[e][a] >= 0 && elements[e][b] >= 0)
          A(elements[e][a], elements[e][b]) += K[e](a, b);
      }
    }
  }
  return A;
}

void expect_dense_equivalent(int size,
                             const std::vector<std::vector<int>>& elements,
                             int block_size) {
  const SymmetricPattern pattern(size, elements);
  EXPECT_EQ(pattern.block_size(), block_size);
  SymmetricMatrix A(pattern);
  std::vector<Eigen::MatrixXd> K;
  for (size_t e = 0; e < elements.size(); ++e) {
    const auto n = static_cast<Eigen::Index>(elements[e].size());
    const Eigen::MatrixXd B = Eigen::MatrixXd::Random(n, n);
    K.push_back(B + B.transpose());
    A.add_element(static_cast<int>(e), K.back().data());
  }
  const Eigen::MatrixXd D = assemble_dense(size, elements, K);
  const Eigen::MatrixXd X = Eigen::MatrixXd::Random(size, 3);
  Eigen::MatrixXd Y(size, 3);
  A.multiply(X, Y);
  EXPECT_LT((Y - D * X).norm(), 1e-13 * Y.norm());
  EXPECT_LT((A.diagonal() - D.diagonal()).norm(), 1e-13 * D.norm());
  for (int i = 0; i < size; ++i) {
    for (int j = 0; j < size; ++j) EXPECT_NEAR(A.coefficient(i, j), D(i, j), 1e-12);
  }
}

TEST(SymmetricMatrix, EqualsTheDenseAssemblyOfWholeNodes) {
  const Lattice lattice({3, 3, 2}, 3, /*ring=*/true, /*held_ends=*/true);
  expect_dense_equivalent(lattice.size(), lattice.elements(), 3);
}

TEST(SymmetricMatrix, EqualsTheDenseAssemblyOfSingleUnknowns) {
  const Lattice lattice({3, 2, 2}, 1);
  expect_dense_equivalent(lattice.size(), lattice.elements(), 1);
}

TEST(SymmetricMatrix, HoldsSingleDirectionsOfANode) {
  expect_dense_equivalent(5, {{0, 1, -1, 2, 3, 4}, {3, -1, 0}}, 1);
}

// In a ring of two sectors a node appears twice in one element.
TEST(SymmetricMatrix, ElementMeetingItselfAroundATwoSectorRing) {
  expect_dense_equivalent(6, {{0, 1, 2, 3, 4, 5, 0, 1, 2}}, 3);
}

TEST(SymmetricMatrix, AddsMatricesAndDiagonals) {
  const Lattice lattice({2, 2, 1}, 3);
  const SymmetricPattern pattern(lattice.size(), lattice.elements());
  SymmetricMatrix A(pattern), B(pattern);
  lattice.assemble_random(A, 1);
  lattice.assemble_random(B, 2);
  SymmetricMatrix C = A;
  C.add(-0.5, B);
  C.add_to_diagonal(2.0);
  EXPECT_NEAR(C.coefficient(4, 4), A.coefficient(4, 4) - 0.5 * B.coefficient(4, 4) + 2.0, 1e-13);
  EXPECT_NEAR(C.coefficient(4, 7), A.coefficient(4, 7) - 0.5 * B.coefficient(4, 7), 1e-13);
}

}  // namespace
}  // namespace latsch::numerics
