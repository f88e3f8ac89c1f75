// SPDX-License-Identifier: Apache-2.0
#include "numerics/sparse/davidson.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/QR>

#include "numerics/dense/self_adjoint_eigen.h"
#include "numerics/sparse/factorization.h"
#include "numerics/sparse/lattice_testing.h"

namespace latsch::numerics {
namespace {

constexpr int kWanted = 6;

/// A ring, whose eigenvalues are double, and vectors near its lowest eigenvectors.
struct Ring {
  Lattice lattice{{8, 2, 2}, 3, true};
  SymmetricPattern pattern{lattice.size(), lattice.elements()};
  SymmetricMatrix K{pattern}, M{pattern};
  Factorization factor{pattern, Precision::single};
  Eigen::VectorXd exact;
  Eigen::MatrixXd near;

  explicit Ring(double error) {
    lattice.assemble_equal(K, 3);
    lattice.assemble_equal(M, 8);
    factor.factorize(K);
    exact = generalized_eigenvalues(dense(K), dense(M));
    // The number of vectors is chosen at the largest gap between eigenvalues, so that the
    // eigenvalues left out are far from those included.
    int count = kWanted;
    for (int k = kWanted; k < 2 * kWanted; ++k) {
      if (exact[k] / exact[k - 1] > exact[count] / exact[count - 1]) count = k;
    }
    // Repeated multiplication of random vectors by K^-1 M leaves combinations of the lowest
    // eigenvectors.
    Eigen::MatrixXd X = Eigen::MatrixXd::Random(K.size(), count);
    const Eigen::MatrixXd op = dense(K).inverse() * dense(M);
    for (int i = 0; i < 300; ++i) {
      X = Eigen::HouseholderQR<Eigen::MatrixXd>(op * X).householderQ() *
          Eigen::MatrixXd::Identity(X.rows(), count);
    }
    near = X + error * Eigen::MatrixXd::Random(X.rows(), X.cols()) * X.cwiseAbs().mean();
  }
  double largest_error(const EigenPairs<double>& pairs) const {
    return (pairs.values.cwiseQuotient(exact.head(pairs.values.size())).array() - 1.0)
        .head(kWanted)
        .abs()
        .maxCoeff();
  }
};

TEST(Davidson, FindsTheEigenpairsOfThePencilThoughTheSolverIsRough) {
  const Ring ring(1e-2);
  const auto solve = [&](Eigen::Ref<Eigen::MatrixXd> X) { ring.factor.solve_columns(X); };
  for (const Eigen::Index wanted : {ring.near.cols(), Eigen::Index{kWanted}}) {
    const auto pairs = Davidson(ring.K, ring.M, solve, ring.near).find(wanted, 1e-6);
    ASSERT_TRUE(pairs.converged);
    ASSERT_EQ(pairs.vectors.cols(), wanted);
    EXPECT_LT(ring.largest_error(pairs), 2e-9);
    const Eigen::MatrixXd V = pairs.vectors, M = dense(ring.M);
    EXPECT_LT((V.transpose() * M * V - Eigen::MatrixXd::Identity(wanted, wanted)).norm(), 1e-10);
  }
}

TEST(Davidson, ErrsInValuesByTheSquareOfWhatItErrsInVectors) {
  for (double error : {1e-2, 1e-4}) {
    const Ring ring(error);
    const auto solve = [&](Eigen::Ref<Eigen::MatrixXd> X) { ring.factor.solve_columns(X); };
    const auto pairs =
        Davidson(ring.K, ring.M, solve, ring.near).find(ring.near.cols(), 1.0);  // no corrections
    EXPECT_LT(ring.largest_error(pairs), 10.0 * error * error);
    EXPECT_GT(ring.largest_error(pairs), 0.01 * error * error);
  }
}

TEST(Davidson, GoesOnFromWhatItFoundToSharperVectors) {
  constexpr double kTolerance = 1e-9;
  const Ring ring(1e-2);
  const auto solve = [&](Eigen::Ref<Eigen::MatrixXd> X) { ring.factor.solve_columns(X); };
  Davidson search(ring.K, ring.M, solve, ring.near);
  ASSERT_TRUE(search.find(ring.near.cols(), 1e-3).converged);
  const auto pairs = search.sharpen(kWanted, kTolerance);
  ASSERT_TRUE(pairs.converged);
  ASSERT_EQ(pairs.vectors.cols(), kWanted);
  const Eigen::MatrixXd V = pairs.vectors, K = dense(ring.K), M = dense(ring.M);
  const Eigen::MatrixXd d = K.inverse() * (K * V - M * V * pairs.values.asDiagonal());
  EXPECT_LT((d.transpose() * M * d).diagonal().cwiseSqrt().maxCoeff(), kTolerance);
  EXPECT_LT((V.transpose() * M * V - Eigen::MatrixXd::Identity(kWanted, kWanted)).norm(), 1e-10);
}

TEST(Davidson, DoesNotConvergeByASolverThatKnowsNothing) {
  const Ring ring(0.3);
  const auto blind = [](Eigen::Ref<Eigen::MatrixXd> X) { X.setRandom(); };
  EXPECT_FALSE(Davidson(ring.K, ring.M, blind, ring.near).find(ring.near.cols(), 1e-6).converged);
}

}  // namespace
}  // namespace latsch::numerics
