// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/analysis/condensed_tire.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace latsch::fe_tire {
namespace {

constexpr int kSize = 40;

/// Positive definite but for `shift`, of springs in a row and to the wall.
Eigen::MatrixXd springs(double shift) {
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(kSize, kSize);
  for (int i = 0; i < kSize; ++i) {
    S(i, i) = 2.1 + 0.01 * i + shift;
    if (i > 0) S(i, i - 1) = S(i - 1, i) = -1.0;
  }
  return S;
}

/// Stiff where it sticks, with a part that is not symmetric where it slides.
GroundTangent ground(const std::vector<int>& rows, bool slides) {
  const auto m = std::ssize(rows);
  GroundTangent tangent{rows, Eigen::MatrixXd::Identity(m, m) * 50.0, {}};
  for (Eigen::Index i = 1; i < m; ++i)
    tangent.stiffness(i, i - 1) = tangent.stiffness(i - 1, i) = 7.0;
  if (!slides) return tangent;
  tangent.coupling.setZero(m, m);
  for (Eigen::Index i = 1; i < m; ++i) tangent.coupling(i, i - 1) = 11.0;
  return tangent;
}

Eigen::MatrixXd sum(const Eigen::MatrixXd& S, const GroundTangent& tangent, bool with_coupling) {
  Eigen::MatrixXd all = S;
  for (std::size_t i = 0; i < tangent.rows.size(); ++i) {
    for (std::size_t j = 0; j < tangent.rows.size(); ++j) {
      all(tangent.rows[i], tangent.rows[j]) += tangent.stiffness(i, j);
      if (with_coupling) all(tangent.rows[i], tangent.rows[j]) += tangent.coupling(i, j);
    }
  }
  return all;
}

// On ground that grows and moves on; also with a tire that stands by the ground alone.
TEST(CondensedTire, AnswersAsTheDenseSumOfBoth) {
  const Eigen::VectorXd r = Eigen::VectorXd::LinSpaced(kSize, -1.0, 2.0);
  for (const double shift : {0.0, -0.2}) {
    const Eigen::MatrixXd S = springs(shift);
    ASSERT_EQ(S.llt().info() == Eigen::Success, shift == 0.0);
    CondensedTire tire;
    tire.set(S);
    for (const std::vector<int>& rows : {std::vector<int>{},
                                         std::vector<int>{3, 4, 5, 20},
                                         std::vector<int>{0, 4, 5, 6, 12, 20, 21, 30, 39}}) {
      if (rows.empty() && shift < 0.0) continue;
      const GroundTangent slides = ground(rows, !rows.empty());
      const Eigen::VectorXd dense = sum(S, slides, !rows.empty()).partialPivLu().solve(r);
      EXPECT_TRUE(tire.newton_step(slides, r).isApprox(dense, 1e-11)) << shift;
      ASSERT_TRUE(tire.take(slides)) << shift;
      Eigen::VectorXd v = r;
      tire.solve(v);
      EXPECT_TRUE(v.isApprox(sum(S, slides, false).partialPivLu().solve(r), 1e-11)) << shift;
      EXPECT_TRUE((S * v + tire.multiply_ground(v)).isApprox(r, 1e-11)) << shift;
    }
  }
}

TEST(CondensedTire, SaysWhereGroundMakesItUnstable) {
  CondensedTire tire;
  tire.set(springs(0.0));
  GroundTangent pulls = ground({3, 4}, false);
  pulls.stiffness *= -1.0;
  EXPECT_FALSE(tire.take(pulls));
  tire.set(springs(-1.0));
  EXPECT_FALSE(tire.take(ground({3, 4}, false)));
}

}  // namespace
}  // namespace latsch::fe_tire
