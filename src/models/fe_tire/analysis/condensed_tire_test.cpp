// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/analysis/condensed_tire.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace latsch::fe_tire {
namespace {

constexpr int kSize = 40;
// Relative error of a solution in single precision, for matrices with a condition number below 100.
constexpr double kSingle = 1e-5;

/// Returns the stiffness matrix of masses in a row, joined by springs to each other and to a wall.
/// It is positive definite unless `shift` is too negative.
Eigen::MatrixXd springs(double shift) {
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(kSize, kSize);
  for (int i = 0; i < kSize; ++i) {
    S(i, i) = 2.1 + 0.01 * i + shift;
    if (i > 0) S(i, i - 1) = S(i - 1, i) = -1.0;
  }
  return S;
}

/// Returns the tangent of a ground that is stiff where points stick. If points slide, it has a part
/// that is not symmetric.
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

/// Returns the sum of S and the ground's tangent in the rows within reach.
Eigen::MatrixXd sum(Eigen::MatrixXd S,
                    const std::vector<int>& reached,
                    const GroundTangent& tangent) {
  for (std::size_t i = 0; i < tangent.rows.size(); ++i) {
    for (std::size_t j = 0; j < tangent.rows.size(); ++j) {
      double& at = S(reached[tangent.rows[i]], reached[tangent.rows[j]]);
      at += tangent.stiffness(i, j);
      if (!tangent.is_symmetric()) at += tangent.coupling(i, j);
    }
  }
  return S;
}

// The set of touching points grows and moves, and between few and all of the rows are within the
// ground's reach.
TEST(CondensedTire, AnswersAsTheDenseSumOfBoth) {
  const Eigen::VectorXd r = Eigen::VectorXd::LinSpaced(kSize, -1.0, 2.0);
  const Eigen::MatrixXd S = springs(0.0);
  std::vector<int> all(kSize);
  for (int i = 0; i < kSize; ++i) all[i] = i;
  for (const std::vector<int>& reached :
       {std::vector<int>{2, 3, 4, 5, 9, 20, 30, 39}, std::vector<int>{}, all}) {
    CondensedTire tire;
    ASSERT_TRUE(tire.set(S, reached));
    for (const std::vector<int>& rows :
         {std::vector<int>{}, std::vector<int>{3}, std::vector<int>{0, 2, 4, 5, 7}}) {
      if (!rows.empty() && reached.empty()) continue;
      for (const bool slides : {false, true}) {
        const GroundTangent tangent = ground(rows, slides && !rows.empty());
        Eigen::VectorXd v = r, within = tire.reduce(v);
        tire.factorize(tangent);
        EXPECT_TRUE(tire.is_positive());
        const Eigen::VectorXd left = within;
        tire.solve(within);
        EXPECT_TRUE((tire.multiply(within) + product(tangent, within)).isApprox(left, kSingle));
        tire.expand(within, v);
        EXPECT_TRUE(v.isApprox(sum(S, reached, tangent).partialPivLu().solve(r), kSingle));
      }
    }
  }
}

// The ground's tangent makes the tire stable or unstable, depending on its sign. A step of Newton's
// method must be exact in both cases.
TEST(CondensedTire, SaysWhereGroundMakesItUnstable) {
  const Eigen::VectorXd r = Eigen::VectorXd::LinSpaced(kSize, -1.0, 2.0);
  CondensedTire tire;
  for (const double pull : {1.0, -1.0}) {
    ASSERT_TRUE(tire.set(springs(0.0), {3, 4}));
    GroundTangent tangent = ground({0, 1}, false);
    tangent.stiffness *= pull;
    tire.factorize(tangent);
    EXPECT_EQ(tire.is_positive(), pull > 0.0);
    Eigen::VectorXd v = r, within = tire.reduce(v);
    tire.solve(within);
    tire.expand(within, v);
    EXPECT_TRUE(v.isApprox(sum(springs(0.0), {3, 4}, tangent).partialPivLu().solve(r), kSingle));
  }
  EXPECT_FALSE(tire.set(springs(-1.0), {3, 4}));
}

}  // namespace
}  // namespace latsch::fe_tire
