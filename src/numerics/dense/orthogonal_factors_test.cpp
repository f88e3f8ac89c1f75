// SPDX-License-Identifier: Apache-2.0
#include "numerics/dense/orthogonal_factors.h"

#include <gtest/gtest.h>

#include "numerics/dense/singular_values.h"

namespace latsch::numerics {
namespace {

/// Matrix for fitting a straight line at t = 0, 1, 2, 3, and values 1 + 2 t plus a part that is
/// orthogonal to every straight line.
const Eigen::MatrixXd kLine = (Eigen::MatrixXd(4, 2) << 1, 0, 1, 1, 1, 2, 1, 3).finished();
const Eigen::VectorXd kValues = (Eigen::VectorXd(4) << 2, 2, 4, 8).finished();
const Eigen::Vector2d kOneAndTwo(1.0, 2.0);

TEST(HouseholderQr, SolvesByItsFactors) {
  const HouseholderQr qr(kLine);
  EXPECT_LT((qr.Q().transpose() * qr.Q() - Eigen::Matrix4d::Identity()).norm(), 1e-15);
  const Eigen::VectorXd rotated = qr.times_Q_transposed(kValues);
  EXPECT_LT((rotated - qr.Q().transpose() * kValues).norm(), 1e-14);
  EXPECT_LT((qr.times_Q(rotated) - kValues).norm(), 1e-14);
  EXPECT_LT((qr.solve_R(rotated) - kOneAndTwo).norm(), 1e-14);
}

TEST(PivotedQr, TellsWhichColumnsAreIndependent) {
  Eigen::MatrixXd A(4, 3);
  A << kLine.col(0), kLine.col(1), kLine.col(0) + kLine.col(1);
  const PivotedQr qr = pivoted_qr(A, 1e-9);
  EXPECT_EQ(qr.rank, 2);
  EXPECT_EQ(qr.order.front(), 2);  // the longest column comes first
  EXPECT_LT((qr.Q.rightCols(2).transpose() * A).norm(), 1e-14);
  const Eigen::MatrixXd Q = range_basis(A);
  ASSERT_EQ(Q.cols(), 2);
  EXPECT_LT((A - Q * (Q.transpose() * A)).norm(), 1e-14);
}

TEST(LeastSquaresSolution, FitsALine) {
  EXPECT_LT((least_squares_solution(kLine, kValues) - kOneAndTwo).norm(), 1e-14);
  EXPECT_LT((shortest_solution(kLine, kValues) - kOneAndTwo).norm(), 1e-14);
}

TEST(ShortestSolution, IsTheShortestWhereThereAreMany) {  // the plane x + 2 y + 2 z = 9
  const Eigen::MatrixXd A = Eigen::RowVector3d(1.0, 2.0, 2.0),
                        B = Eigen::MatrixXd::Constant(1, 1, 9);
  EXPECT_LT((shortest_solution(A, B).col(0) - Eigen::Vector3d(1.0, 2.0, 2.0)).norm(), 1e-14);
}

TEST(SingularValues, AreKnownInClosedForm) {
  const auto square = singular_values((Eigen::Matrix2d() << 3, 0, 4, 5).finished());
  EXPECT_NEAR(square.values[0], std::sqrt(45.0), 1e-14);
  EXPECT_NEAR(square.values[1], std::sqrt(5.0), 1e-14);
  const Eigen::MatrixXd row = Eigen::RowVector3d(1.0, 2.0, 2.0);
  const auto wide = singular_values(row);
  ASSERT_EQ(wide.values.size(), 1);
  EXPECT_NEAR(wide.values[0], 3.0, 1e-15);
  EXPECT_NEAR((row * wide.V.col(0)).cwiseAbs()[0], 3.0, 1e-14);
  EXPECT_LT((row * wide.V.rightCols(2)).norm(), 1e-15);
}

}  // namespace
}  // namespace latsch::numerics
