// SPDX-License-Identifier: Apache-2.0
#include "numerics/sparse/conjugate_gradients.h"

#include <gtest/gtest.h>

#include "numerics/dense/cholesky.h"
#include "numerics/dense/orthogonal_factors.h"

namespace latsch::numerics {
namespace {

ConjugateGradients::Operator times(const Eigen::MatrixXd& A) {
  return [&A](const Eigen::VectorXd& x, Eigen::VectorXd& y) { y.noalias() = A * x; };
}
void none(Eigen::VectorXd&) {}

// The claim is theorem 5.4 of Nocedal & Wright.
TEST(ConjugateGradients, NeedsAsManyIterationsAsThereAreDistinctEigenvalues) {
  Eigen::VectorXd lambda(60);
  for (int k = 0; k < 60; ++k) lambda[k] = 1.0 + k % 4;
  const Eigen::MatrixXd Q = HouseholderQr(Eigen::MatrixXd::Random(60, 60)).Q();
  const Eigen::MatrixXd A = Q * lambda.asDiagonal() * Q.transpose();
  const Eigen::VectorXd b = Eigen::VectorXd::Random(60);
  Eigen::VectorXd x;
  ConjugateGradients cg(60);
  const CgOutcome outcome = cg.solve(times(A), none, b, 1e-12, 100, x);
  EXPECT_EQ(outcome.end, CgOutcome::End::converged);
  EXPECT_EQ(outcome.iterations, 4);
  EXPECT_LT((A * x - b).norm(), 1e-11 * b.norm());
}

TEST(ConjugateGradients, ForeseesWhereItsIterationsDoNotSuffice) {
  constexpr int kMost = 24;
  const Eigen::VectorXd b = Eigen::VectorXd::Ones(400);
  for (const double condition : {1.5, 1e4}) {
    const Eigen::MatrixXd A = Eigen::VectorXd::LinSpaced(400, 1.0, condition).asDiagonal();
    Eigen::VectorXd x, all;
    ConjugateGradients cg(400);
    const CgOutcome to_the_end = cg.solve(times(A), none, b, 1e-10, kMost, all);
    const CgOutcome outcome = cg.solve(times(A), none, b, 1e-10, kMost, x, true);
    EXPECT_EQ(outcome.end, to_the_end.end) << condition;
    if (condition > 100.0) {
      EXPECT_EQ(outcome.end, CgOutcome::End::iterations_spent);
      EXPECT_LT(outcome.iterations, kMost / 2);
    } else {
      EXPECT_EQ(outcome.end, CgOutcome::End::converged);
      EXPECT_EQ(x, all);
    }
  }
}

TEST(ConjugateGradients, IsDoneAtOnceWithTheMatrixAsItsOwnPreconditioner) {
  const Eigen::MatrixXd B = Eigen::MatrixXd::Random(30, 30);
  const Eigen::MatrixXd A = B * B.transpose() + Eigen::MatrixXd::Identity(30, 30);
  const Cholesky factor(A);
  const Eigen::VectorXd b = Eigen::VectorXd::Random(30);
  Eigen::VectorXd x;
  ConjugateGradients cg(30);
  const auto outcome = cg.solve(
      times(A), [&](Eigen::VectorXd& z) { z = factor.solve(z); }, b, 1e-10, 9, x);
  EXPECT_EQ(outcome.iterations, 1);
}

TEST(ConjugateGradients, ReportsNegativeCurvatureWithADescentDirection) {
  Eigen::MatrixXd A = Eigen::Vector3d(1.0, 2.0, -1.0).asDiagonal();
  ConjugateGradients cg(3);
  for (const Eigen::Vector3d& first : {Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(0, 0, 1)}) {
    const Eigen::VectorXd b = first;
    Eigen::VectorXd x;
    const auto outcome = cg.solve(times(A), none, b, 1e-10, 9, x);
    EXPECT_EQ(outcome.end, CgOutcome::End::negative_curvature);
    EXPECT_GT(x.dot(b), 0.0);
  }
}

TEST(ConjugateGradients, SaysWhenIterationsAreSpent) {
  const Eigen::MatrixXd A = Eigen::VectorXd::LinSpaced(50, 1.0, 1e4).asDiagonal();
  const Eigen::VectorXd b = Eigen::VectorXd::Ones(50);
  Eigen::VectorXd x;
  ConjugateGradients cg(50);
  const auto outcome = cg.solve(times(A), none, b, 1e-14, 3, x);
  EXPECT_EQ(outcome.end, CgOutcome::End::iterations_spent);
  EXPECT_EQ(outcome.iterations, 3);
}

TEST(ConjugateGradients, AnswersZeroToZero) {
  const Eigen::MatrixXd A = Eigen::MatrixXd::Identity(3, 3);
  Eigen::VectorXd x;
  EXPECT_EQ(
      ConjugateGradients(3).solve(times(A), none, Eigen::VectorXd::Zero(3), 1e-9, 5, x).iterations,
      0);
  EXPECT_EQ(x.norm(), 0.0);
}

}  // namespace
}  // namespace latsch::numerics
