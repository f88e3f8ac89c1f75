// SPDX-License-Identifier: Apache-2.0
#include "numerics/sparse/front_algebra.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "numerics/kernels/kernel_set.h"

namespace latsch::numerics {
namespace {

using Eigen::MatrixXd, Eigen::MatrixXf;

/// Result for a front of `pivots` and `below` rows: its eliminated panel and its update.
struct Front {
  MatrixXf panel, update;
};

/// Returns the panel [all x pivots] of a positive definite matrix, the same in every run.
MatrixXf panel_of(int pivots, int below) {
  const int all = pivots + below;
  MatrixXf A(all, pivots);
  for (int j = 0; j < pivots; ++j) {
    for (int i = 0; i < all; ++i) {
      const int a = std::min(i, j), b = std::max(i, j);
      A(i, j) = static_cast<float>((37 * a + 101 * b + 11 * a * b) % 97) / 97.0f - 0.5f;
    }
    A(j, j) = static_cast<float>(pivots);
  }
  return A;
}

Front eliminated(MatrixXf A, int below) {
  const int all = static_cast<int>(A.rows()), pivots = static_cast<int>(A.cols());
  Front front{std::move(A), MatrixXf::Zero(below, below)};
  EXPECT_TRUE(cholesky(pivots, front.panel.data(), all));
  solve_right_transposed(below, pivots, front.panel.data(), all, front.panel.data() + pivots);
  negative_square(below, pivots, front.panel.data() + pivots, all, front.update.data());
  front.panel.topRows(pivots).triangularView<Eigen::StrictlyUpper>().setZero();
  front.update.triangularView<Eigen::StrictlyUpper>().setZero();
  return front;
}

/// Sizes of fronts for which the kernels of front_kernels.h are used, for which BLAS is used, and
/// on both sides of the limits between them.
const std::vector<std::pair<int, int>> kSizes = {{1, 1},
                                                 {2, 7},
                                                 {3, 40},
                                                 {6, 9},
                                                 {13, 16},
                                                 {27, 101},
                                                 {96, 130},
                                                 {97, 31},
                                                 {250, 60},
                                                 {12, 515}};

TEST(FrontAlgebra, IsThatOfDoublePrecision) {
  for (const KernelSet set : kernel_sets()) {
    const WithKernelSet with(set);
    for (const auto& [pivots, below] : kSizes) {
      const MatrixXf A = panel_of(pivots, below);
      const auto [panel, update] = eliminated(A, below);
      const MatrixXd L = panel.cast<double>();
      MatrixXd square = L * L.topRows(pivots).transpose() - A.cast<double>();
      square.topRows(pivots).triangularView<Eigen::StrictlyUpper>().setZero();
      // The bound on the error is (n + 1) eps |L| |L'| [Higham, Accuracy and Stability of Numerical
      // Algorithms, theorem 10.3]. The norm of a row of L is at most the square root of the
      // diagonal entry of A in the same row.
      const double rounding = (pivots + 1) * 6e-8 * pivots;
      EXPECT_LT(square.cwiseAbs().maxCoeff(), rounding) << pivots << " " << below;
      MatrixXd left = update.cast<double>() + L.bottomRows(below) * L.bottomRows(below).transpose();
      left.triangularView<Eigen::StrictlyUpper>().setZero();
      EXPECT_LT(left.cwiseAbs().maxCoeff(), rounding) << pivots << " " << below;
    }
  }
}

TEST(FrontAlgebra, HasTheSameBitsOnBothWideSets) {
  std::vector<Front> first;
  for (const KernelSet set : kernel_sets()) {
    if (set == KernelSet::baseline) continue;
    const WithKernelSet with(set);
    std::vector<Front> fronts;
    for (const auto& [pivots, below] : kSizes)
      fronts.push_back(eliminated(panel_of(pivots, below), below));
    if (first.empty()) first = fronts;
    for (std::size_t k = 0; k < fronts.size(); ++k) {
      EXPECT_EQ(fronts[k].panel, first[k].panel);
      EXPECT_EQ(fronts[k].update, first[k].update);
    }
  }
}

TEST(FrontAlgebra, NeitherReadsNorWritesBesideAPanel) {
  constexpr int kPivots = 9, kBelow = 11, kBeside = 5, kAll = kPivots + kBelow + kBeside;
  const MatrixXf A = panel_of(kPivots, kBelow + kBeside);
  MatrixXf whole = A;
  whole.bottomRows(kBeside).setConstant(NAN);
  ASSERT_TRUE(cholesky(kPivots, whole.data(), kAll));
  solve_right_transposed(kBelow, kPivots, whole.data(), kAll, whole.data() + kPivots);
  EXPECT_TRUE(whole.bottomRows(kBeside).array().isNaN().all());
  EXPECT_TRUE(whole.topRows(kPivots + kBelow).allFinite());
  MatrixXf update = MatrixXf::Constant(kBelow, kBelow + 1, 7.0f);
  negative_square(kBelow, kPivots, whole.data() + kPivots, kAll, update.data());
  EXPECT_TRUE(update.leftCols(kBelow).allFinite());
  EXPECT_TRUE((update.col(kBelow).array() == 7.0f).all());
}

TEST(FrontAlgebra, TellsWhatIsNotPositive) {
  for (const KernelSet set : kernel_sets()) {
    const WithKernelSet with(set);
    for (const int n : {3, 50, 130}) {
      for (const int wrong : {0, n / 2, n - 1}) {
        MatrixXf A = panel_of(n, 0);
        A(wrong, wrong) = -1.0f;
        EXPECT_FALSE(cholesky(n, A.data(), n));
        A = panel_of(n, 0);
        A(wrong, wrong) = NAN;
        EXPECT_FALSE(cholesky(n, A.data(), n));
      }
    }
  }
}

}  // namespace
}  // namespace latsch::numerics
