// SPDX-License-Identifier: Apache-2.0
#include "numerics/sparse/lanczos.h"

#include <gtest/gtest.h>

#include "numerics/dense/dense_products.h"
#include "numerics/dense/self_adjoint_eigen.h"
#include "numerics/sparse/factorization.h"
#include "numerics/sparse/lattice_testing.h"

namespace latsch::numerics {
namespace {

template <class Scalar>
using Dense = DenseMatrix<Scalar>;

/// Returns A B*.
template <class Scalar>
Dense<Scalar> times_adjoint(const Dense<Scalar>& A, const Dense<Scalar>& B) {
  return overlaps<Scalar>(A.adjoint(), B.adjoint());
}

template <class Scalar>
Dense<Scalar> scaled(const Dense<Scalar>& A, const Eigen::VectorXd& columns) {
  return A * columns.cast<Scalar>().asDiagonal();
}

template <class Scalar>
EigenProblem<Scalar> dense_problem(const Dense<Scalar>& K, const Dense<Scalar>& M, double shift) {
  const auto [values, V] = self_adjoint_eigen(Dense<Scalar>(K - Scalar(shift) * M));
  const Dense<Scalar> inverse = times_adjoint(scaled(V, values.cwiseInverse()), V);
  EigenProblem<Scalar> problem;
  problem.size = static_cast<int>(K.rows());
  problem.shift = shift;
  problem.solve = [inverse](Eigen::Ref<Dense<Scalar>> X) { X = overlaps<Scalar>(inverse, X); };
  problem.mass = [M](const Eigen::Ref<const Dense<Scalar>>& X, Eigen::Ref<Dense<Scalar>> Y) {
    Y = overlaps<Scalar>(M, X);
  };
  return problem;
}

template <class Scalar>
Dense<Scalar> random_positive(int n) {
  const Dense<Scalar> B = Dense<Scalar>::Random(n, n);
  return times_adjoint(B, B) + Dense<Scalar>::Identity(n, n);
}

template <class Scalar>
struct KAndM {
  Dense<Scalar> K, M;
};

/// Returns K with the given eigenvalues with respect to M: K = F diag(lambda) F', M = F F'. By the
/// circular law the random part of F has its eigenvalues within sqrt(2 n / 3), so F is not near
/// singular.
template <class Scalar>
KAndM<Scalar> with_spectrum(const Eigen::VectorXd& lambda) {
  const Eigen::Index n = lambda.size();
  Dense<Scalar> F = Dense<Scalar>::Random(n, n);
  F.diagonal().array() += std::sqrt(static_cast<double>(n));
  return {times_adjoint(scaled(F, lambda), F), times_adjoint(F, F)};
}

template <class Scalar>
void expect_pairs(const EigenPairs<Scalar>& pairs,
                  const Dense<Scalar>& K,
                  const Dense<Scalar>& M,
                  const Eigen::VectorXd& expected) {
  ASSERT_TRUE(pairs.converged);
  ASSERT_EQ(pairs.values.size(), expected.size());
  for (int k = 0; k < expected.size(); ++k)
    EXPECT_NEAR(pairs.values[k], expected[k], 1e-10 * expected[k]) << k;
  const Dense<Scalar>& X = pairs.vectors;
  const Dense<Scalar> KX = overlaps<Scalar>(K, X), MX = overlaps<Scalar>(M, X);
  const Dense<Scalar> gram = overlaps<Scalar>(X, MX);
  EXPECT_LT((gram - Dense<Scalar>::Identity(gram.rows(), gram.cols())).norm(), 1e-9);
  for (int k = 0; k < expected.size(); ++k) {
    EXPECT_LT((KX.col(k) - pairs.values[k] * MX.col(k)).norm(), 1e-5 * KX.col(k).norm());
  }
}

template <class Scalar>
class LanczosOf : public testing::Test {};
using Scalars = testing::Types<double, std::complex<double>>;
TYPED_TEST_SUITE(LanczosOf, Scalars);

TYPED_TEST(LanczosOf, FindsWhatADenseSolverFinds) {
  using M = Dense<TypeParam>;
  const M K = random_positive<TypeParam>(120), mass = random_positive<TypeParam>(120);
  const Eigen::VectorXd all = generalized_eigenvalues(K, mass);
  for (int block : {1, 2, 5}) {
    const auto pairs =
        lanczos(dense_problem<TypeParam>(K, mass, 0.0), {.count = 12, .block = block});
    expect_pairs<TypeParam>(pairs, K, mass, all.head(12));
  }
}

TYPED_TEST(LanczosOf, FindsAllCopiesOfPairs) {
  Eigen::VectorXd lambda(90);
  for (int k = 0; k < 90; ++k) lambda[k] = 1.0 + 0.8 * (k / 2);
  const auto [K, M] = with_spectrum<TypeParam>(lambda);
  const auto pairs = lanczos(dense_problem<TypeParam>(K, M, 0.2), {.count = 20, .block = 2});
  expect_pairs<TypeParam>(pairs, K, M, lambda.head(20));
}

TYPED_TEST(LanczosOf, LeavesTheSparePairsRough) {
  Eigen::VectorXd lambda(100);
  for (int k = 0; k < 100; ++k) lambda[k] = std::pow(1.0 + k, 1.2);
  const auto [K, M] = with_spectrum<TypeParam>(lambda);
  const auto problem = dense_problem<TypeParam>(K, M, 0.0);
  LanczosSettings settings{.count = 12, .block = 2};
  const auto all = lanczos(problem, settings);
  settings.spare = 3;
  settings.spare_tolerance = 0.02;
  auto some = lanczos(problem, settings);
  EXPECT_LT(some.solves, all.solves);
  ASSERT_EQ(some.values.size(), 12);
  EXPECT_LT((some.values.tail(3).cwiseQuotient(lambda.segment(9, 3)).array() - 1.0).maxCoeff(),
            0.02);
  some.values.conservativeResize(9);
  some.vectors.conservativeResize(Eigen::NoChange, 9);
  expect_pairs<TypeParam>(some, K, M, lambda.head(9));
}

TYPED_TEST(LanczosOf, StartsFromANeighborAndStillFindsWhatItLacks) {
  Eigen::VectorXd lambda(100);
  for (int k = 0; k < 100; ++k) lambda[k] = std::pow(1.0 + k, 1.5);
  const auto [K, M] = with_spectrum<TypeParam>(lambda);
  const auto problem = dense_problem<TypeParam>(K, M, 0.0);
  const auto cold = lanczos(problem, {.count = 10, .block = 2});
  Dense<TypeParam> start = cold.vectors;
  start.col(3) = start.col(4);  // a dependent column; the fourth mode is missing
  start += 1e-4 * start.norm() * Dense<TypeParam>::Random(100, 10);
  const auto warm = lanczos(problem, {.count = 10, .block = 2}, start);
  expect_pairs<TypeParam>(warm, K, M, lambda.head(10));
  const auto exact = lanczos(problem, {.count = 10, .block = 2}, cold.vectors);
  expect_pairs<TypeParam>(exact, K, M, lambda.head(10));
  EXPECT_LT(exact.solves, cold.solves / 2);
}

TYPED_TEST(LanczosOf, EndsWithAllPairsOfASmallProblem) {
  const auto K = random_positive<TypeParam>(7), M = random_positive<TypeParam>(7);
  const Eigen::VectorXd all = generalized_eigenvalues(K, M);
  expect_pairs<TypeParam>(
      lanczos(dense_problem<TypeParam>(K, M, 0.0), {.count = 9, .block = 3}), K, M, all);
}

// The start vectors span eigenvectors that are not wanted.
TYPED_TEST(LanczosOf, LeavesAnInvariantSubspace) {
  Eigen::VectorXd lambda = Eigen::VectorXd::LinSpaced(40, 1.0, 40.0);
  const Dense<TypeParam> M = Dense<TypeParam>::Identity(40, 40);
  const Dense<TypeParam> K = lambda.cast<TypeParam>().asDiagonal();
  const Dense<TypeParam> start = M.rightCols(6);
  expect_pairs<TypeParam>(
      lanczos(dense_problem<TypeParam>(K, M, 0.0), {.count = 5, .block = 2}, start),
      K,
      M,
      lambda.head(5));
}

TEST(Lanczos, GivesTheSameBitsTwice) {
  const Eigen::MatrixXd K = random_positive<double>(60), M = random_positive<double>(60);
  const auto problem = dense_problem<double>(K, M, 0.0);
  const auto once = lanczos(problem, {.count = 8}), again = lanczos(problem, {.count = 8});
  EXPECT_EQ(once.values, again.values);
  EXPECT_EQ(once.vectors, again.vectors);
}

// In a ring all eigenvalues are double.
TEST(Lanczos, MissesNoneBelowTheLastByInertia) {
  const Lattice lattice({12, 4, 2}, 3, /*ring=*/true, /*held_ends=*/true);
  const SymmetricPattern pattern(lattice.size(), lattice.elements());
  SymmetricMatrix K(pattern), M(pattern);
  lattice.assemble_equal(K, 5);
  lattice.assemble_equal(M, 6);
  Factorization factor(pattern);
  ASSERT_TRUE(factor.factorize(K).definite());
  EigenProblem<double> problem;
  problem.size = K.size();
  problem.solve = [&](Eigen::Ref<Eigen::MatrixXd> X) { factor.solve_columns(X); };
  problem.mass = [&](const Eigen::Ref<const Eigen::MatrixXd>& X, Eigen::Ref<Eigen::MatrixXd> Y) {
    M.multiply(X, Y);
  };
  const auto pairs = lanczos(problem, {.count = 20});
  ASSERT_TRUE(pairs.converged);
  for (int k : {4, 9, 14, 19}) {
    SymmetricMatrix shifted = K;
    shifted.add(-pairs.values[k] * (1.0 + 1e-7), M);
    int below = 0;
    for (double value : pairs.values) below += value <= pairs.values[k] * (1.0 + 1e-7);
    const auto negative = (self_adjoint_eigenvalues(dense(shifted)).array() < 0.0).count();
    EXPECT_GE(negative, below);
    if (k < 19) {
      EXPECT_EQ(negative, below);
    }
  }
}

// A block of two vectors finds two copies of an eigenvalue; rounding errors bring the third and the
// fourth.
TEST(Lanczos, FindsMoreCopiesThanTheBlockIsWide) {
  Eigen::VectorXd lambda(80);
  for (int k = 0; k < 80; ++k) lambda[k] = 1.0 + 0.5 * (k / 4);
  const auto [K, M] = with_spectrum<double>(lambda);
  const auto pairs =
      lanczos(dense_problem<double>(K, M, 0.1), {.count = 12, .tolerance = 1e-9, .block = 4});
  expect_pairs<double>(pairs, K, M, lambda.head(12));
}

TEST(Lanczos, EndsUnconvergedWhereTheSolutionsAreNotNumbers) {
  EigenProblem<double> problem;
  problem.size = 30;
  problem.solve = [](Eigen::Ref<Eigen::MatrixXd> X) { X.setConstant(std::nan("")); };
  problem.mass = [](const Eigen::Ref<const Eigen::MatrixXd>& X, Eigen::Ref<Eigen::MatrixXd> Y) {
    Y = X;
  };
  EXPECT_FALSE(lanczos(problem, {.count = 5, .max_steps = 50}).converged);
}

TEST(Lanczos, EndsUnconvergedWhereNothingHasMass) {
  EigenProblem<double> problem;
  problem.size = 30;
  problem.solve = [](Eigen::Ref<Eigen::MatrixXd>) {};
  problem.mass = [](const Eigen::Ref<const Eigen::MatrixXd>&, Eigen::Ref<Eigen::MatrixXd> Y) {
    Y.setZero();
  };
  const auto pairs = lanczos(problem, {.count = 5, .max_steps = 50});
  EXPECT_FALSE(pairs.converged);
  EXPECT_EQ(pairs.values.size(), 0);
}

TEST(Lanczos, EigenvalueErrorGoesWithTheSquareOfTheResidual) {
  const Eigen::VectorXd lambda = Eigen::VectorXd::LinSpaced(200, 1.0, 200.0);
  const auto [K, M] = with_spectrum<double>(lambda);
  for (double tolerance : {1e-2, 1e-3, 1e-4}) {
    const auto pairs =
        lanczos(dense_problem<double>(K, M, 0.0), {.count = 4, .tolerance = tolerance, .block = 1});
    ASSERT_TRUE(pairs.converged);
    // The error of the eigenvalue theta of the inverted problem is at most (tolerance theta)^2 /
    // gap, and the gap to the next theta is at least theta / (k + 2).
    for (int k = 0; k < 4; ++k) {
      EXPECT_NEAR(pairs.values[k], lambda[k], (k + 2) * tolerance * tolerance * lambda[k] + 1e-12);
    }
  }
}

}  // namespace
}  // namespace latsch::numerics
