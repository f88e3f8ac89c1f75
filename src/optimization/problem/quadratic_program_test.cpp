// SPDX-License-Identifier: Apache-2.0
#include "optimization/problem/quadratic_program.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace latsch {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

QuadraticProgram nearest_to(const VectorXd& u) {
  const auto n = u.size();
  return {MatrixXd::Identity(n, n), -u, MatrixXd(0, n), VectorXd(0), MatrixXd(0, n), VectorXd(0)};
}

TEST(QuadraticProgram, SolvesTheExampleOfTheBook) {
  // The solution of example 16.4 in [Nocedal & Wright, Numerical Optimization, 2006] is x = (1.4,
  // 1.7).
  QuadraticProgram qp;
  qp.G = 2.0 * MatrixXd::Identity(2, 2);
  qp.g = Eigen::Vector2d(-2.0, -5.0);
  qp.E = MatrixXd(0, 2);
  qp.A.resize(5, 2);
  qp.A << -1, 2,  //
      1, 2,       //
      1, -2,      //
      -1, 0,      //
      0, -1;
  qp.b.resize(5);
  qp.b << 2, 6, 2, 0, 0;
  const QuadraticSolution solution = solve(qp);
  EXPECT_NEAR(solution.x[0], 1.4, 1e-14);
  EXPECT_NEAR(solution.x[1], 1.7, 1e-14);
  EXPECT_NEAR(solution.mu[0], 0.8, 1e-14);
}

TEST(QuadraticProgram, FulfillsTheConditionsOfKarushKuhnAndTucker) {
  RandomStream random(3, 1);
  const auto draw = [&](int rows, int cols) {
    MatrixXd M(rows, cols);
    for (double& value : M.reshaped()) value = 2.0 * random.uniform() - 1.0;
    return M;
  };
  for (int trial = 0; trial < 200; ++trial) {
    const int n = 2 + trial % 9, equations = trial % 3 == 0 ? 1 : 0, inequalities = 2 * n + 3;
    QuadraticProgram qp;
    const MatrixXd R = draw(n, n);
    qp.G = R.transpose() * R + 0.01 * MatrixXd::Identity(n, n);
    qp.g = 5.0 * draw(n, 1);
    qp.E = draw(equations, n);
    qp.A = draw(inequalities, n);
    const VectorXd inside = draw(n, 1);
    qp.f = qp.E * inside;
    // In half of the trials all planes pass through the point.
    qp.b = qp.A * inside + draw(inequalities, 1).cwiseAbs() * (trial % 2);
    const QuadraticSolution s = solve(qp);
    ASSERT_TRUE(s.is_feasible());
    const VectorXd slope =
        qp.G * s.x + qp.g + qp.E.transpose() * s.lambda + qp.A.transpose() * s.mu;
    const double size = 1.0 + s.mu.norm() + s.lambda.norm();
    EXPECT_LT(slope.norm(), 1e-10 * size);
    EXPECT_LT((qp.A * s.x - qp.b).maxCoeff(), 1e-10);
    EXPECT_LT((qp.E * s.x - qp.f).norm(), 1e-10);
    EXPECT_GE(s.mu.minCoeff(), 0.0);
    EXPECT_LT(std::abs(s.mu.dot(qp.A * s.x - qp.b)), 1e-9 * size);
  }
}

TEST(QuadraticProgram, NamesRowsThatContradictEachOther) {
  QuadraticProgram qp = nearest_to(Eigen::Vector2d(0.3, 0.4));
  qp.A.resize(3, 2);
  qp.A << 1, 0,  //
      1, 1,      //
      -1, -1;
  qp.b.resize(3);
  qp.b << 5, 1, -2;
  EXPECT_EQ(solve(qp).contradiction, (std::vector<int>{1, 2}));
  qp.E = Eigen::RowVector2d(0, 1);
  qp.f = VectorXd::Constant(1, -5.0);
  qp.A.row(2) << -1, 0;
  qp.b << 0, 9, -1;
  EXPECT_EQ(solve(qp).contradiction, (std::vector<int>{1, 3}));
}

TEST(QuadraticProgram, BearsRepeatedAndDependentRows) {
  QuadraticProgram qp = nearest_to(Eigen::Vector3d(2, 2, 2));
  qp.E.resize(3, 3);
  qp.E << 1, 1, 0,  //
      2, 2, 0,      //
      1, 1, 0;
  qp.f = Eigen::Vector3d(1, 2, 1);
  qp.A = MatrixXd::Ones(4, 3);
  qp.b = VectorXd::Constant(4, 1.5);
  const QuadraticSolution s = solve(qp);
  ASSERT_TRUE(s.is_feasible());
  EXPECT_LT((s.x - Eigen::Vector3d(0.5, 0.5, 0.5)).norm(), 1e-13);
}

TEST(QuadraticProgram, OutOfStepsIsNotFeasible) {
  QuadraticProgram program;
  program.G = Eigen::Matrix2d::Identity();
  program.g = Eigen::Vector2d::Zero();
  program.E.resize(0, 2);
  program.A = Eigen::MatrixXd{{-1.0, 0.0}};
  program.b = Eigen::VectorXd::Constant(1, -1.0);  // x_1 >= 1
  EXPECT_TRUE(solve(program).is_feasible());
  const QuadraticSolution cut_short = solve(program, 0);
  EXPECT_TRUE(cut_short.is_out_of_steps);
  EXPECT_FALSE(cut_short.is_feasible());
}

}  // namespace
}  // namespace latsch
