// SPDX-License-Identifier: Apache-2.0
// Tests of linear constraints of a design space: refused inputs, projection onto the constraints,
// and tangent cones at corners.
#include "optimization/problem/linear_constraint.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "optimization/problem/hock_schittkowski_testing.h"
#include "optimization/region/conforming_set.h"
#include "optimization/region/tangent_cone.h"

namespace latsch {
namespace {

/// Returns the message with which a space is refused.
std::string refusal(const std::vector<double>& start,
                    std::vector<LinearConstraint> rows,
                    Scale scale = Scale::linear) {
  for (size_t i = 0; i < rows.size(); ++i) {
    rows[i].name = fmt::format("c{}", i + 1);
    rows[i].place = {"study.toml", static_cast<int>(i) + 1};
  }
  std::vector<DesignVariable> variables = space_of(start, {{1, 10}}).variables();
  variables.front().scale = scale;
  try {
    DesignSpace(variables, rows);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

void expect_words(const std::string& message, const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    EXPECT_NE(message.find(word), std::string::npos) << message << "\nlacks " << word;
  }
}

TEST(LinearConstraint, NamesTheRowTheAmountAndTheNearestPoint) {
  // The point of x1 + x2 = 8 nearest to (6, 8) is (3, 5).
  expect_words(refusal({6, 8}, {at_most({1, -1}, 9), at_most({1, 1}, 8)}),
               {"study.toml:2", "\"c2\"", "is 14", "6 above its bound 8", "x1 = 3, x2 = 5"});
  expect_words(refusal({2, 2}, {at_least({1, 1}, 6)}), {"2 below its bound 6"});
}

TEST(LinearConstraint, NamesThoseThatContradictEachOtherAndNoOther) {
  const std::string message =
      refusal({5, 5}, {at_most({1, 0}, 9), at_most({1, 1}, 8), at_least({2, 2}, 17)});
  expect_words(message, {"\"c2\" (study.toml:2)", "\"c3\" (study.toml:3)", "contradict"});
  EXPECT_EQ(message.find("\"c1\""), std::string::npos);
  expect_words(refusal({5, 5}, {at_least({1, 1}, 21)}),
               {"c1", "x1 of at most 10", "x2 of at most"});
  expect_words(refusal({5, 5}, {equal({1, 1}, 4), equal({1, 1}, 5)}), {"\"c1\"", "\"c2\""});
}

TEST(LinearConstraint, RefusesRowsThatAreNone) {
  expect_words(refusal({5, 5}, {at_most({0, 0}, 1)}), {"study.toml:1", "has no variable"});
  expect_words(refusal({5, 5}, {at_most({1, 1}, INFINITY)}), {"has no bound"});
  expect_words(refusal({5, 5}, {between({1, 1}, 3, 2)}), {"lower bound 3 is above upper bound 2"});
  expect_words(refusal({5, 5}, {at_most({1}, 1)}), {"1 coefficients for 2 variables"});
  expect_words(refusal({5, 5}, {at_most({NAN, 1}, 1)}), {"coefficient of x1 is nan"});
  expect_words(refusal({5, 5}, {at_most({1, 1}, 12)}, Scale::logarithmic),
               {"\"x1\" is logarithmic", "scale = \"linear\""});
  EXPECT_EQ(refusal({5, 5}, {at_most({0, 1}, 12)}, Scale::logarithmic), "");
}

TEST(LinearConstraint, AStartRoundedByAPersonIsMovedOntoTheEquation) {
  const DesignSpace space =
      space_of({3.333333, 3.333333, 3.333333}, {{0, 10}}, {equal({1, 1, 1}, 10)});
  const DesignPoint start = space.initial();
  EXPECT_NEAR(start.values[0] + start.values[1] + start.values[2], 10.0, 1e-14);
  EXPECT_TRUE(space.contains(start));
  EXPECT_FALSE(space.contains({{3, 3, 3}}));
}

TEST(LinearConstraint, StaysWithTheSpaceWhereItsBoundsAreTightened) {
  const DesignSpace space = space_of({2, 2}, {{0, 10}}, {at_most({1, 1}, 4)});
  EXPECT_FALSE(space.tightened({{2, 2}}, 0.5).contains({{3, 3}}));
  EXPECT_TRUE(space.starting_at({{1, 3}}).contains({{1, 3}}));
}

TEST(FeasibleRegion, CutsAWayOffAtTheFirstConstraint) {
  const FeasibleRegion region(space_of({2, 2}, {{0, 10}}, {at_most({1, 1}, 10)}));
  const Eigen::Vector2d x(0.2, 0.2);
  const Eigen::VectorXd end = region.cut_off(x, Eigen::Vector2d(0.8, 1.0));
  EXPECT_NEAR(end.sum(), 1.0, 1e-15);
  EXPECT_NEAR((end[1] - 0.2) / (end[0] - 0.2), 0.8 / 0.6, 1e-14);
  EXPECT_EQ(region.cut_off(x, Eigen::Vector2d(-0.2, 0.2)), Eigen::Vector2d(0.0, 0.2));
  EXPECT_EQ(region.cut_off(x, Eigen::Vector2d(0.3, 0.3)), Eigen::Vector2d(0.3, 0.3));
}

/// Returns the largest entry of V'd over all generators d of the cone; it is positive if one of
/// them leads out of the region.
double leads_out(const ConeGenerators& cone, const Eigen::MatrixXd& V) {
  double most = 0.0;
  if (V.cols() == 0) return most;
  for (const auto& d : cone.rays) most = std::max(most, (V.transpose() * d).maxCoeff());
  if (cone.lines.cols() > 0) {
    most = std::max(most, (V.transpose() * cone.lines).cwiseAbs().maxCoeff());
  }
  return most;
}

TEST(TangentCone, OfIndependentPlanesIsSpannedByTheirEdges) {
  Eigen::MatrixXd V(3, 2);
  V << 1, 0,  //
      0, 1,   //
      0, 0;
  const ConeGenerators cone = tangent_cone(V, Eigen::MatrixXd(3, 0));
  ASSERT_EQ(cone.rays.size(), 2u);
  EXPECT_EQ(cone.lines.cols(), 1);
  EXPECT_NEAR(std::abs(cone.lines(2, 0)), 1.0, 1e-15);
  EXPECT_LT(leads_out(cone, V), 1e-15);
}

TEST(TangentCone, AtACornerOfTheCrossPolytopeIsThatOfItsEdges) {
  // 2^(n-1) planes  x_1 +- x_2 ... +- x_n <= 1  meet at the corner e_1; its edges lead to the 2 (n
  // - 1) corners +-e_2 ... +-e_n.
  for (const int n : {2, 3, 5, 7}) {
    Eigen::MatrixXd V(n, 1 << (n - 1));
    for (int k = 0; k < V.cols(); ++k) {
      V(0, k) = 1.0;
      for (int i = 1; i < n; ++i) V(i, k) = (k >> (i - 1)) & 1 ? -1.0 : 1.0;
    }
    const ConeGenerators cone = tangent_cone(V, Eigen::MatrixXd(n, 0));
    EXPECT_EQ(cone.rays.size(), 2u * (n - 1));
    EXPECT_EQ(cone.lines.cols(), 0);
    for (const Eigen::VectorXd& d : cone.rays) {
      EXPECT_NEAR(d[0], -std::sqrt(0.5), 1e-12);
      EXPECT_NEAR(d.tail(n - 1).cwiseAbs().maxCoeff(), std::sqrt(0.5), 1e-12);
    }
    EXPECT_LT(leads_out(cone, V), 1e-12);
  }
}

TEST(TangentCone, StaysInEquationsAndKnowsOppositePlanes) {
  // Between the parallel planes, x1 + x2 + x3 = const leaves a single line of directions.
  Eigen::MatrixXd V(3, 2), E(3, 1);
  V << 1, -1,  //
      0, 0,    //
      0, 0;
  E << 1, 1, 1;
  const ConeGenerators cone = tangent_cone(V, E);
  EXPECT_TRUE(cone.rays.empty());
  ASSERT_EQ(cone.lines.cols(), 1);
  EXPECT_LT((cone.lines.col(0).cwiseAbs() - Eigen::Vector3d(0, 1, 1) / std::sqrt(2)).norm(), 1e-14);
}

TEST(ConformingSet, StaysInsideForAStepOfEpsilonAndPointsDownhillWhereItCan) {
  // The polytopes around a point are random. If the projection of -g on the tangent cone is not 0,
  // one of the core directions leads downhill.
  RandomStream random(7, 1);
  int corners = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const int n = 2 + trial % 4;
    std::vector<LinearConstraint> rows;
    for (int r = 0; r < n + 1; ++r) {
      std::vector<double> a;
      double length = 0.0, middle = 0.0;
      for (int i = 0; i < n; ++i) {
        a.push_back(random.uniform() - 0.5);
        length += a.back() * a.back();
        middle += 0.5 * a.back();
      }
      rows.push_back(at_most(a, middle + std::sqrt(length) * 0.2 * random.uniform()));
    }
    const FeasibleRegion region(space_of(std::vector<double>(n, 0.5), {{0, 1}}, rows));
    const Eigen::VectorXd x = Eigen::VectorXd::Constant(n, 0.5);
    const double epsilon = 0.1;
    Eigen::VectorXd g(n);
    for (double& value : g) value = random.uniform() - 0.5;
    const auto directions = conforming_set(region, x, epsilon, trial);
    double steepest = 0.0;
    Eigen::VectorXd distance = region.b() - region.A() * x;
    const bool is_corner = (distance.array() <= epsilon).count() >= n;
    corners += is_corner;
    for (const Eigen::VectorXd& d : directions) {
      EXPECT_NEAR(d.norm(), 1.0, 1e-12);
      if (region.contains(x + epsilon * d)) steepest = std::min(steepest, g.dot(d));
    }
    // The minimum of g'd over the cone with |d|_inf <= 1 is negative if and only if one of the rays
    // descends.
    Eigen::MatrixXd V(n, 0);
    for (Eigen::Index i = 0; i < distance.size(); ++i) {
      if (distance[i] > epsilon) continue;
      V.conservativeResize(Eigen::NoChange, V.cols() + 1);
      V.col(V.cols() - 1) = region.A().row(i).transpose();
    }
    const ConeGenerators cone = tangent_cone(V, Eigen::MatrixXd(n, 0));
    if ((cone.lines.transpose() * g).norm() > 0.01) {
      EXPECT_LT(steepest, 0.0);
    }
    for (const Eigen::VectorXd& ray : cone.rays) {
      const bool descends = g.dot(ray) < -0.01;
      EXPECT_TRUE(!descends || steepest < 0.0);
    }
    EXPECT_LT(leads_out(cone, V), 1e-9);
  }
  EXPECT_GT(corners, 20);
}

}  // namespace
}  // namespace latsch
