// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/belt/belt_curve.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace latsch::ring_tire {
namespace {

NodeValues random_nodes(int nodes) {
  RandomStream random(5, 1);
  return NodeValues::NullaryExpr(
      4, nodes, [&](Eigen::Index, Eigen::Index) { return random.uniform(); });
}

/// The cubic B-spline by its definition: de Boor's recursion over equal knots [de Boor 1978].
double b_spline(int degree, double x) {
  if (degree == 0) return x >= 0.0 && x < 1.0 ? 1.0 : 0.0;
  return (x * b_spline(degree - 1, x) + (degree + 1 - x) * b_spline(degree - 1, x - 1.0)) / degree;
}

TEST(BeltCurve, IsTheBSplineOfItsDefinition) {
  for (const double s : {0.0, 0.1, 0.5, 0.99}) {
    const CurveWeights at = curve_weights(s);
    for (std::size_t m = 0; m < 4; ++m) {
      const double x = s + 3.0 - static_cast<double>(m);
      EXPECT_NEAR(at.place[m], b_spline(3, x), 1e-15) << s << " " << m;
      EXPECT_NEAR(at.slope[m], b_spline(2, x) - b_spline(2, x - 1.0), 1e-15) << s << " " << m;
    }
  }
}

TEST(BeltCurve, GoesThroughItsKnots) {
  const NodeValues x = random_nodes(12), knots = at_knots(x);
  const CurveWeights begin = curve_weights(0.0), end = curve_weights(1.0);
  for (int k = 0; k < 12; ++k) {
    Eigen::Vector4d first = Eigen::Vector4d::Zero(), last = first;
    for (int m = 0; m < 4; ++m) {
      first += begin.place[static_cast<std::size_t>(m)] * x.col((k + m + 11) % 12);
      last += end.place[static_cast<std::size_t>(m)] * x.col((k + m + 11) % 12);
    }
    EXPECT_LT((first - knots.col(k)).norm(), 1e-15);
    EXPECT_LT((last - knots.col((k + 1) % 12)).norm(), 1e-15);
  }
}

TEST(BeltCurve, CountsWhatStandsAtAKnotOnItsNodes) {
  const NodeValues x = random_nodes(12);
  Eigen::Matrix4d k = Eigen::Matrix4d::Random();
  k = (k + k.transpose()).eval();
  for (const int knot : {0, 5, 11}) {
    CyclicBand K(12);
    add_at_knot(k, knot, K);
    NodeValues at_one = NodeValues::Zero(4, 12);
    at_one.col(knot) = k * at_knots(x).col(knot);
    EXPECT_LT((K.multiply(x) - at_knots(at_one)).norm(), 1e-14) << knot;
  }
}

TEST(BeltCurve, OfNodesOnACircleHasItsKnotsOnASmallerOne) {
  constexpr int N = 20;
  const NodeAngles angles(N);
  const RimFrame rim = RimFrame::of(WheelMotion());
  NodeValues x = NodeValues::Zero(4, N);
  for (int k = 0; k < N; ++k)
    x.col(k).head<3>() = node_radius_over_knot_radius(N) * angles.radial(rim, k);
  const NodeValues knots = at_knots(x);
  for (int k = 0; k < N; ++k)
    EXPECT_LT((knots.col(k).head<3>() - angles.radial(rim, k)).norm(), 1e-15);
}

}  // namespace
}  // namespace latsch::ring_tire
