// SPDX-License-Identifier: Apache-2.0
#include "numerics/sparse/factorization.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>

#include "numerics/dense/self_adjoint_eigen.h"
#include "numerics/sparse/conjugate_gradients.h"
#include "numerics/sparse/elimination.h"
#include "numerics/sparse/lattice_testing.h"

namespace latsch::numerics {
namespace {

TEST(Factorization, SolvesAsADenseSolverDoes) {
  const Lattice lattice({5, 3, 4}, 3);
  const SymmetricPattern pattern(lattice.size(), lattice.elements());
  SymmetricMatrix A(pattern);
  lattice.assemble_random(A, 7);
  Factorization factor(pattern);
  ASSERT_TRUE(factor.factorize(A).definite());
  const Eigen::MatrixXd B = Eigen::MatrixXd::Random(A.size(), 9);
  Eigen::MatrixXd X = B;
  factor.solve_columns(X);
  EXPECT_LT((dense(A) * X - B).norm(), 1e-11 * B.norm());
  Eigen::VectorXd x = B.col(4);
  factor.solve(x);
  EXPECT_LT((x - X.col(4)).norm(), 1e-12 * x.norm());
}

// float rounds at 6e-8; two iterations square the error.
TEST(Factorization, InSinglePrecisionIsAPreconditioner) {
  const Lattice lattice({6, 4, 3}, 3);
  const SymmetricPattern pattern(lattice.size(), lattice.elements());
  SymmetricMatrix A(pattern);
  lattice.assemble_random(A, 11);
  Factorization factor(pattern, Precision::single);
  ASSERT_TRUE(factor.factorize(A).definite());
  for (double scale : {1.0, 1e-60, 1e60}) {  // scales beyond the exponents of float
    const Eigen::VectorXd b = scale * Eigen::VectorXd::Random(A.size());
    Eigen::VectorXd x = b, residual(A.size());
    factor.solve(x);
    A.multiply(x.data(), residual.data());
    EXPECT_LT((residual - b).norm(), 1e-3 * b.norm());
    ConjugateGradients cg(A.size());
    const auto outcome = cg.solve(
        [&](const Eigen::VectorXd& p, Eigen::VectorXd& Ap) { A.multiply(p.data(), Ap.data()); },
        [&](Eigen::VectorXd& z) { factor.solve(z); },
        b,
        1e-11,
        10,
        x);
    EXPECT_EQ(outcome.end, CgOutcome::End::converged);
    EXPECT_LE(outcome.iterations, 4);
  }
}

TEST(Factorization, IsThatOfAPositiveMatrixAndOfNoOther) {
  // The matrix is shifted so that its lowest eigenvalue is just above or just below zero, or so
  // that many of its eigenvalues are negative.
  const Lattice lattice({4, 3, 3}, 3);
  const SymmetricPattern pattern(lattice.size(), lattice.elements());
  SymmetricMatrix A(pattern);
  lattice.assemble_random(A, 3);
  const Eigen::VectorXd lambda = self_adjoint_eigenvalues(dense(A));
  for (Precision precision : {Precision::full, Precision::single}) {
    Factorization factor(pattern, precision);
    const double gap = precision == Precision::full ? 1e-9 : 1e-3;
    for (double shift : {(1.0 - gap) * lambda[0],
                         (1.0 + gap) * lambda[0],
                         0.5 * (lambda[1] + lambda[2]),
                         2.0 * lambda.tail(1)[0]}) {
      SymmetricMatrix shifted = A;
      shifted.add_to_diagonal(-shift);
      const FactorStatus status = factor.factorize(shifted);
      EXPECT_EQ(status.outcome,
                shift < lambda[0] ? FactorStatus::Outcome::definite
                                  : FactorStatus::Outcome::not_positive);
    }
  }
}

TEST(Factorization, SaysThatAMatrixIsSingular) {
  const SymmetricPattern pattern(2, {{0, 1}});
  SymmetricMatrix A(pattern);
  const double K[4] = {1, -1, -1, 1};
  A.add_element(0, K);
  Factorization factor(pattern);
  EXPECT_EQ(factor.factorize(A).outcome, FactorStatus::Outcome::not_positive);
  A.add_to_diagonal(1.0);
  EXPECT_TRUE(factor.factorize(A).definite());
}

TEST(Factorization, SolvesWhereUnknownsStandAloneOrInParts) {
  // Tests three cases: no couplings at all, two bodies that are not connected, and one unknown per
  // node.
  const SymmetricPattern alone(7, {});
  SymmetricMatrix D(alone);
  D.add_to_diagonal(4.0);
  Factorization of_alone(alone);
  ASSERT_TRUE(of_alone.factorize(D).definite());
  Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(7, 1.0, 7.0);
  of_alone.solve(x);
  EXPECT_LT((4.0 * x - Eigen::VectorXd::LinSpaced(7, 1.0, 7.0)).norm(), 1e-14);

  for (int per_node : {1, 3}) {
    const Lattice lattice({5, 4, 3}, per_node);
    auto elements = lattice.elements();
    const auto one = elements;
    for (auto unknowns : one) {
      for (int& unknown : unknowns) unknown += lattice.size();
      elements.push_back(unknowns);
    }
    const SymmetricPattern pattern(2 * lattice.size(), elements);
    SymmetricMatrix A(pattern);
    lattice.assemble_random(A, 5);
    for (int e = 0; e < static_cast<int>(one.size()); ++e) {
      const Eigen::MatrixXd I = (1.0 + e) * Eigen::MatrixXd::Identity(8 * per_node, 8 * per_node) +
                                Eigen::MatrixXd::Ones(8 * per_node, 8 * per_node);
      A.add_element(static_cast<int>(one.size()) + e, I.data());
    }
    Factorization factor(pattern);
    ASSERT_TRUE(factor.factorize(A).definite());
    // More columns than are solved for together.
    const Eigen::MatrixXd B = Eigen::MatrixXd::Random(A.size(), 70);
    Eigen::MatrixXd X = B;
    factor.solve_columns(X);
    EXPECT_LT((dense(A) * X - B).norm(), 1e-11 * B.norm());
  }
}

// A contact makes one node a million times stiffer than the others.
TEST(Factorization, KeepsItsAccuracyBesideAStiffPenalty) {
  const Lattice lattice({6, 4, 3}, 3);
  auto elements = lattice.elements();
  elements.push_back({0, 1, 2});
  const SymmetricPattern pattern(lattice.size(), elements);
  SymmetricMatrix A(pattern);
  lattice.assemble_random(A, 4);
  const double before = A.coefficient(0, 0);
  const Eigen::Matrix3d penalty = 1e6 * before * Eigen::Matrix3d::Identity();
  A.add_element(static_cast<int>(elements.size()) - 1, penalty.data());
  Factorization factor(pattern);
  ASSERT_TRUE(factor.factorize(A).definite());
  const Eigen::VectorXd x = Eigen::VectorXd::Random(A.size());
  Eigen::VectorXd b(A.size());
  A.multiply(x.data(), b.data());
  factor.solve(b);
  EXPECT_LT((b - x).norm(), 1e-9 * x.norm());
}

TEST(Factorization, FailsOnAMatrixThatIsNotNumbers) {
  const Lattice lattice({3, 2, 2}, 3);
  const SymmetricPattern pattern(lattice.size(), lattice.elements());
  SymmetricMatrix A(pattern);
  lattice.assemble_random(A, 4);
  A.values()[17] = std::nan("");
  for (Precision precision : {Precision::full, Precision::single}) {
    Factorization factor(pattern, precision);
    EXPECT_EQ(factor.factorize(A).outcome, FactorStatus::Outcome::failed);
  }
}

TEST(Factorization, MayShareTheOrderOfElimination) {
  const Lattice lattice({6, 4, 3}, 3);
  const SymmetricPattern pattern(lattice.size(), lattice.elements());
  SymmetricMatrix A(pattern);
  lattice.assemble_random(A, 9);
  const Factorization rough(pattern, Precision::single);
  Factorization alone(pattern), shared(pattern, Precision::full, rough.elimination());
  ASSERT_TRUE(alone.factorize(A).definite() && shared.factorize(A).definite());
  const Eigen::VectorXd b = Eigen::VectorXd::Random(A.size());
  Eigen::VectorXd x = b, y = b;
  alone.solve(x);
  shared.solve(y);
  EXPECT_EQ(x, y);
}

/// A lattice some of whose nodes form an interface. They are neither the first nodes nor adjacent.
struct WithInterface {
  Lattice lattice{{6, 5, 4}, 3};
  SymmetricPattern pattern{lattice.size(), lattice.elements()};
  std::vector<int> block_rows = {40, 3, 17, 18, 77, 119};
  SymmetricMatrix A{pattern};
  Factorization factor{
      pattern,
      Precision::full,
      std::make_shared<const Elimination>(eliminate(pattern, block_rows, eliminate(pattern)))};

  WithInterface() { lattice.assemble_random(A, 5); }
  /// Returns the order in which the unknowns of the interface come first, in their own order, and
  /// all others follow.
  Eigen::PermutationMatrix<Eigen::Dynamic> order() const {
    std::vector<int> unknowns;
    for (int row : block_rows) {
      for (int k = 0; k < 3; ++k) unknowns.push_back(3 * row + k);
    }
    for (int i = 0; i < A.size(); ++i) {
      if (std::find(block_rows.begin(), block_rows.end(), i / 3) == block_rows.end()) {
        unknowns.push_back(i);
      }
    }
    Eigen::PermutationMatrix<Eigen::Dynamic> P(A.size());
    for (int i = 0; i < A.size(); ++i) P.indices()[unknowns[i]] = i;
    return P;
  }
};

TEST(Factorization, AnInterfaceFeelsTheSameInEveryOrder) {
  WithInterface with;
  Factorization own(with.pattern,
                    Precision::full,
                    std::make_shared<const Elimination>(eliminate(with.pattern, with.block_rows)));
  ASSERT_TRUE(own.condense(with.A).definite() && with.factor.condense(with.A).definite());
  const Eigen::MatrixXd S = own.condensed();
  EXPECT_LT((with.factor.condensed() - S).norm(), 1e-12 * S.norm());
}

TEST(Factorization, CondensesToItsInterfaceAsTheSchurComplementSays) {
  WithInterface it;
  ASSERT_TRUE(it.factor.condense(it.A).definite());
  const auto P = it.order();
  const Eigen::MatrixXd A = P * dense(it.A) * P.transpose();
  const int m = 3 * static_cast<int>(it.block_rows.size()), n = it.A.size() - m;
  const Eigen::MatrixXd inner = A.bottomRightCorner(n, n);
  const Eigen::MatrixXd S =
      A.topLeftCorner(m, m) - A.topRightCorner(m, n) * inner.inverse() * A.bottomLeftCorner(n, m);
  EXPECT_LT((it.factor.condensed() - S).norm(), 1e-10 * S.norm());
}

TEST(Factorization, SolvesWithWhateverStandsOnItsInterface) {
  WithInterface it;
  ASSERT_TRUE(it.factor.condense(it.A).definite());
  const auto P = it.order();
  const int m = 3 * static_cast<int>(it.block_rows.size());
  const Eigen::MatrixXd spring = 50.0 * Eigen::MatrixXd::Identity(m, m);
  Eigen::MatrixXd A = P * dense(it.A) * P.transpose();
  A.topLeftCorner(m, m) += spring;
  const Eigen::VectorXd b = Eigen::VectorXd::Random(it.A.size());
  Eigen::VectorXd x = b;
  it.factor.reduce(x);
  Eigen::VectorXd all = P * x;
  all.head(m) = (it.factor.condensed() + spring).inverse() * all.head(m).eval();
  x = P.transpose() * all;
  it.factor.expand(x);
  EXPECT_LT((A * (P * x) - P * b).norm(), 1e-10 * b.norm());
}

TEST(Factorization, AnInterfaceChangesNoSolution) {
  WithInterface it;
  ASSERT_TRUE(it.factor.factorize(it.A).definite());
  const Eigen::VectorXd b = Eigen::VectorXd::Random(it.A.size());
  Eigen::VectorXd x = b;
  it.factor.solve(x);
  EXPECT_LT((dense(it.A) * x - b).norm(), 1e-10 * b.norm());
}

TEST(Factorization, GivesTheSameBitsTwice) {
  const Lattice lattice({6, 4, 3}, 3);
  const SymmetricPattern pattern(lattice.size(), lattice.elements());
  SymmetricMatrix A(pattern);
  lattice.assemble_random(A, 9);
  const Eigen::VectorXd b = Eigen::VectorXd::Random(A.size());
  Eigen::VectorXd once = b, again = b;
  Factorization first(pattern), second(pattern);
  ASSERT_TRUE(first.factorize(A).definite() && second.factorize(A).definite());
  first.solve(once);
  second.factorize(A);  // factorizes a second time in the same object
  second.solve(again);
  EXPECT_EQ(once, again);
}

}  // namespace
}  // namespace latsch::numerics
