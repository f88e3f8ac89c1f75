// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/belt/cyclic_band.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "base/random.h"
#include "models/ring_tire/belt/stiffness_rows.h"
#include "models/ring_tire/description/ring_parameters_testing.h"
#include "models/ring_tire/ring/ring_tire.h"

namespace latsch::ring_tire {
namespace {

CyclicBand random_band(int nodes) {
  RandomStream random(7, static_cast<std::uint64_t>(nodes));
  CyclicBand A(nodes);
  for (int k = 0; k < nodes; ++k)
    for (int j = 0; j <= CyclicBand::kReach; ++j)
      for (int e = 0; e < 16; ++e) A.block(k, j)(e / 4, e % 4) = random.uniform() - 0.5;
  for (int k = 0; k < nodes; ++k) {
    A.block(k, 0) = (A.block(k, 0) + A.block(k, 0).transpose()).eval();
    A.block(k, 0).diagonal().array() += 16.0;  // more than the sums of rows: positive definite
  }
  return A;
}

Eigen::MatrixXd dense(const CyclicBand& A) {
  const int n = A.nodes();
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(4 * n, 4 * n);
  for (int k = 0; k < n; ++k)
    for (int j = 0; j <= CyclicBand::kReach; ++j) {
      const int other = (k + j) % n;
      full.block<4, 4>(4 * k, 4 * other) = A.block(k, j);
      full.block<4, 4>(4 * other, 4 * k) = A.block(k, j).transpose();
    }
  return full;
}

// The dense Cholesky factorization of Eigen is the independent program.
TEST(CyclicBand, SolvesLikeADenseFactorization) {
  for (int nodes : {8, 9, 11, 40}) {
    const CyclicBand A = random_band(nodes);
    Eigen::Matrix4Xd b = Eigen::Matrix4Xd::Ones(4, nodes);
    b.row(1).setLinSpaced(-1.0, 2.0);
    const Eigen::VectorXd expected =
        dense(A).llt().solve(Eigen::Map<const Eigen::VectorXd>(b.data(), b.size()));
    CyclicBandFactor factor(nodes);
    ASSERT_TRUE(factor.factorize(A));
    Eigen::Matrix4Xd x = b;
    factor.solve(x);
    EXPECT_LT((Eigen::Map<const Eigen::VectorXd>(x.data(), x.size()) - expected).norm(),
              1e-13 * expected.norm());
    EXPECT_LT((A.multiply(x) - b).norm(), 1e-13 * b.norm());
    SideBySide many(4 * nodes + 1, 16);  // column j is (j + 1) b
    many.setOnes();
    for (int j = 0; j < 16; ++j) many.col(j).head(4 * nodes) = (j + 1.0) * b.reshaped();
    const SideBySide before = many;
    factor.solve_columns(many);
    EXPECT_LT((A.multiply_columns(SideBySide(many.topRows(4 * nodes))) - before.topRows(4 * nodes))
                  .norm(),
              1e-13 * before.norm());
    for (int j = 0; j < 16; ++j)
      EXPECT_LT((many.col(j).head(4 * nodes) - (j + 1.0) * expected).norm(),
                1e-13 * (j + 1.0) * expected.norm());
    EXPECT_EQ(many.row(4 * nodes), Eigen::RowVectorXd::Ones(16));
  }
}

// The coupling of the border with a node of this matrix falls to a third from node to node.
TEST(CyclicBand, ForgetsTheBorderWhereItHasFaded) {
  const int nodes = 64;
  const double least = 1e-6;
  StiffnessRows rows(nodes);
  rows.start();
  const CyclicBand A = random_band(nodes);
  CyclicBandFactor whole(nodes), short_of(nodes);
  ASSERT_TRUE(whole.factorize(A));
  short_of.start(rows, Eigen::Matrix3d::Identity());
  for (int k = 0; k < nodes; ++k)
    for (int j = 0; j <= CyclicBand::kReach; ++j) short_of.add(k, j, A.block(k, j));
  ASSERT_TRUE(short_of.factorize(least));
  for (int loaded : {0, 20, 40, 62}) {
    Eigen::Matrix4Xd exact = Eigen::Matrix4Xd::Zero(4, nodes);
    exact(1, loaded) = 1.0;
    Eigen::Matrix4Xd x = exact;
    SideBySide many = SideBySide::Zero(4 * nodes, 8);
    many.col(3) = exact.reshaped();
    whole.solve(exact);
    short_of.solve(x);
    short_of.solve_columns(many);
    const double error = (x - exact).norm() / exact.norm();
    EXPECT_LT(error, least) << loaded;
    EXPECT_LT((many.col(3) - x.reshaped()).norm(), 1e-14 * exact.norm()) << loaded;
  }
  Eigen::Matrix4Xd exact = Eigen::Matrix4Xd::Ones(4, nodes), x = exact;
  whole.solve(exact);
  short_of.solve(x);
  EXPECT_GT((x - exact).norm(), 0.0);  // some fill-in was dropped
}

// The free ring's own matrix has a condition of 1e6 to 1e8. The solution is backward stable for any
// length of the chain.
TEST(CyclicBand, SolvesAStiffBeltOfAnyLength) {
  for (int nodes : {48, 96, 160, 320}) {
    RingParameters ring = passenger_ring();
    ring.nodes = nodes;
    const CyclicBand A = RingTire(ring).stiffness();
    Eigen::Matrix4Xd b = Eigen::Matrix4Xd::Ones(4, nodes);
    b.row(1).setLinSpaced(-1.0, 2.0);
    CyclicBandFactor factor(nodes);
    ASSERT_TRUE(factor.factorize(A)) << nodes;
    Eigen::Matrix4Xd x = b;
    factor.solve(x);
    const double size = dense(A).norm() * x.norm();
    EXPECT_LT((A.multiply(x) - b).norm(), 1e-14 * nodes * size) << nodes;
  }
}

// A matrix is given in rotated axes, partly by rows and partly by blocks, and then rotated further.
TEST(CyclicBand, SolvesInTurnedAxes) {
  for (int nodes : {8, 9, 40}) {
    const CyclicBand A = random_band(nodes);
    StiffnessRows rows(nodes);
    rows.start();
    for (int j = 0; j <= CyclicBand::kReach; ++j)
      for (int entry = 0; entry < StiffnessRows::kEntries; ++entry)
        for (int k = 0; k < nodes; ++k)
          rows.row(j, entry)[k] = 0.25 * A.block(k, j)(entry / 4, entry % 4);
    const Eigen::Matrix3d first = Eigen::AngleAxisd(1.0, Eigen::Vector3d(0.6, 0.0, 0.8)).matrix(),
                          then = Eigen::AngleAxisd(-0.4, Eigen::Vector3d::UnitX()) * first;
    CyclicBandFactor factor(nodes);
    factor.start(rows, first);
    for (int k = 0; k < nodes; ++k)
      for (int j = 0; j <= CyclicBand::kReach; ++j) factor.add(k, j, 0.75 * A.block(k, j));
    ASSERT_TRUE(factor.factorize());
    for (const Eigen::Matrix3d& axes : {first, then}) {
      factor.turn_to(axes);
      CyclicBand turned(nodes);
      Eigen::Matrix4d turn = Eigen::Matrix4d::Identity();
      turn.topLeftCorner<3, 3>() = axes;
      for (int k = 0; k < nodes; ++k)
        for (int j = 0; j <= CyclicBand::kReach; ++j)
          turned.block(k, j) = turn * A.block(k, j) * turn.transpose();
      Eigen::Matrix4Xd b = Eigen::Matrix4Xd::Ones(4, nodes);
      b.row(1).setLinSpaced(-1.0, 2.0);
      Eigen::Matrix4Xd x = b;
      factor.solve(x);
      EXPECT_LT((turned.multiply(x) - b).norm(), 1e-13 * b.norm());
      SideBySide many(4 * nodes, 8);
      for (int j = 0; j < 8; ++j) many.col(j) = (j + 1.0) * b.reshaped();
      const SideBySide before = many;
      factor.solve_columns(many);
      EXPECT_LT((turned.multiply_columns(many) - before).norm(), 1e-13 * before.norm());
    }
  }
}

TEST(CyclicBand, RefusesWhatIsNotPositiveDefinite) {
  CyclicBand A = random_band(12);
  for (int k = 0; k < 12; ++k) A.block(k, 0).diagonal().head<3>().array() -= 20.0;
  CyclicBandFactor factor(12);
  EXPECT_FALSE(factor.factorize(A));
}

}  // namespace
}  // namespace latsch::ring_tire
