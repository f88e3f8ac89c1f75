// SPDX-License-Identifier: Apache-2.0
#include "numerics/sparse/columns_together.h"

#include <gtest/gtest.h>

#include <Eigen/Core>

#include "numerics/sparse/factorization.h"
#include "numerics/sparse/lattice_testing.h"

namespace latsch::numerics {
namespace {

using Panel = Eigen::MatrixXf;

/// Returns a panel whose pivots are a lower triangle with a dominant diagonal.
Panel some_panel(int pivots, int rows) {
  Panel L = Panel::Random(rows, pivots) / static_cast<float>(rows);
  for (int j = 0; j < pivots; ++j) L(j, j) = 1.0f + 0.1f * static_cast<float>(j);
  return L;
}

/// Return (L^-1 x, b - B L^-1 x) and (L^-T (x - B' b), b) by their definition, in double.
Eigen::MatrixXd eliminated(const Panel& panel, Eigen::MatrixXd v) {
  for (int j = 0; j < panel.cols(); ++j) {
    v.row(j) /= panel(j, j);
    for (int i = j + 1; i < panel.rows(); ++i) v.row(i) -= double{panel(i, j)} * v.row(j);
  }
  return v;
}
Eigen::MatrixXd substituted(const Panel& panel, Eigen::MatrixXd v) {
  for (int j = static_cast<int>(panel.cols()) - 1; j >= 0; --j) {
    for (int i = j + 1; i < panel.rows(); ++i) v.row(j) -= double{panel(i, j)} * v.row(i);
    v.row(j) /= panel(j, j);
  }
  return v;
}

// Bound on the rounding error of sums of up to 60 numbers of order one, about 60 x 6e-8.
constexpr double kRounding = 4e-6;

TEST(ColumnsTogether, PanelsOfAnyShapeAreSolvedAsDefined) {
  for (const int pivots : {1, 2, 3, 6, 7, 8, 9, 21, 24, 29}) {
    for (const int below : {0, 1, 5, 8, 30}) {
      const int rows = pivots + below;
      const Panel read = some_panel(pivots, rows);
      Eigen::VectorXf panel = Eigen::VectorXf::Zero(read.size() + kRoom);
      panel.head(read.size()) = read.reshaped();
      const Eigen::MatrixXf start = Eigen::MatrixXf::Random(rows, kSolvedTogether);
      const Eigen::MatrixXd exact = start.cast<double>();

      Eigen::MatrixXf v = start.transpose();
      eliminate_columns(pivots, rows, panel.data(), v.data());
      const Eigen::MatrixXd forward = eliminated(read, exact);
      EXPECT_LT((v.transpose().cast<double>() - forward).cwiseAbs().maxCoeff(), kRounding);
      v = start.transpose();
      substitute_columns(pivots, rows, panel.data(), v.data());
      const Eigen::MatrixXd backward = substituted(read, exact);
      EXPECT_LT((v.transpose().cast<double>() - backward).cwiseAbs().maxCoeff(), kRounding);

      Eigen::VectorXf one(rows + kRoom);
      one.head(rows) = start.col(3);
      one.tail(kRoom).setConstant(7.0f);
      eliminate_column(pivots, rows, panel.data(), one.data());
      EXPECT_LT((one.head(rows).cast<double>() - forward.col(3)).cwiseAbs().maxCoeff(), kRounding);
      one.head(rows) = start.col(3);
      substitute_column(pivots, rows, panel.data(), one.data());
      EXPECT_LT((one.head(rows).cast<double>() - backward.col(3)).cwiseAbs().maxCoeff(), kRounding);
    }
  }
}

TEST(ColumnsTogether, ProductsAreThoseOfColumnsOneByOne) {
  const Lattice lattice({5, 3, 4}, 3);
  const SymmetricPattern pattern(lattice.size(), lattice.elements());
  SymmetricMatrix A(pattern);
  lattice.assemble_random(A, 5);
  const Eigen::MatrixXd X = Eigen::MatrixXd::Random(A.size(), 7);
  Eigen::MatrixXd Y(A.size(), 7);
  A.multiply(X, Y);
  for (int k = 0; k < X.cols(); ++k) {
    Eigen::VectorXd y(A.size());
    A.multiply(X.col(k).data(), y.data());
    EXPECT_LT((Y.col(k) - y).norm(), 1e-14 * y.norm());
  }
}

TEST(ColumnsTogether, RefinedSolutionsAreExactToTheirLimit) {
  const Lattice lattice({6, 4, 3}, 3);
  const SymmetricPattern pattern(lattice.size(), lattice.elements());
  SymmetricMatrix A(pattern);
  lattice.assemble_random(A, 11);
  Factorization refined(pattern, Precision::refined);
  ASSERT_TRUE(refined.factorize(A).definite());
  for (const int columns : {1, 3, 8, 13}) {
    const Eigen::MatrixXd B = Eigen::MatrixXd::Random(A.size(), columns);
    Eigen::MatrixXd X = B, product(A.size(), columns);
    refined.solve_columns(X, 1e-9);
    A.multiply(X, product);
    for (int k = 0; k < columns; ++k) {
      EXPECT_LT((product - B).col(k).norm(), 1e-9 * B.col(k).norm());
    }
  }
}

}  // namespace
}  // namespace latsch::numerics
