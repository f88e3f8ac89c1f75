// SPDX-License-Identifier: Apache-2.0
#include "numerics/sparse/gmres.h"

#include <gtest/gtest.h>

#include "numerics/dense/lu.h"

namespace latsch::numerics {
namespace {

ConjugateGradients::Operator times(const Eigen::MatrixXd& A) {
  return [&A](const Eigen::VectorXd& x, Eigen::VectorXd& y) { y.noalias() = A * x; };
}
void none(Eigen::VectorXd&) {}

// The preconditioned matrix is the identity plus a matrix of rank two, so it has three distinct
// eigenvalues.
TEST(Gmres, NeedsOneIterationMoreThanTheRankItsPreconditionerIsOff) {
  const Eigen::MatrixXd M =
      Eigen::MatrixXd::Random(50, 50) + 10.0 * Eigen::MatrixXd::Identity(50, 50);
  const Eigen::MatrixXd A = M + Eigen::MatrixXd::Random(50, 2) * Eigen::MatrixXd::Random(2, 50);
  Lu lu;
  lu.factorize(M);
  const auto precondition = [&lu](Eigen::VectorXd& z) {
    Eigen::MatrixXd column = z;
    lu.solve(column);
    z = column.col(0);
  };
  const Eigen::VectorXd b = Eigen::VectorXd::Random(50);
  Eigen::VectorXd x;
  const CgOutcome outcome = gmres(times(A), precondition, b, 1e-11, 20, x);
  EXPECT_EQ(outcome.end, CgOutcome::End::converged);
  EXPECT_EQ(outcome.iterations, 3);
  EXPECT_LT((A * x - b).norm(), 1e-10 * b.norm());
}

TEST(Gmres, SaysWhatItsLastIterationLeft) {
  const Eigen::MatrixXd A =
      Eigen::MatrixXd::Random(50, 50) + 5.0 * Eigen::MatrixXd::Identity(50, 50);
  const Eigen::VectorXd b = Eigen::VectorXd::Ones(50);
  Eigen::VectorXd x;
  const CgOutcome outcome = gmres(times(A), none, b, 1e-14, 4, x);
  EXPECT_EQ(outcome.end, CgOutcome::End::iterations_spent);
  EXPECT_EQ(outcome.iterations, 4);
  EXPECT_NEAR((A * x - b).norm() / b.norm(), outcome.residual, 1e-12);
}

TEST(Gmres, AnswersZeroToZero) {
  const Eigen::MatrixXd A = Eigen::MatrixXd::Identity(3, 3);
  Eigen::VectorXd x;
  EXPECT_EQ(gmres(times(A), none, Eigen::VectorXd::Zero(3), 1e-9, 5, x).iterations, 0);
  EXPECT_EQ(x.norm(), 0.0);
}

}  // namespace
}  // namespace latsch::numerics
