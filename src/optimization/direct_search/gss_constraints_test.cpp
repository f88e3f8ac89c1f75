// SPDX-License-Identifier: Apache-2.0
// Tests of generating-set search with linear constraints.
#include <gtest/gtest.h>

#include <cmath>

#include "optimization/design/sobol.h"
#include "optimization/direct_search/gss.h"
#include "optimization/problem/feasible_region.h"
#include "optimization/problem/hock_schittkowski_testing.h"

namespace latsch {
namespace {

struct Found {
  std::vector<double> x;
  double f = INFINITY;
  int evaluations = 0;
};

/// Runs the search until it converges and checks that every proposed point lies inside the region.
Found minimize(const ConstrainedProblem& problem, const GssOptions& options = {}) {
  Gss gss(problem.space, options);
  Found found;
  while (!gss.converged() && found.evaluations < 5000) {
    const DesignPoint point = gss.propose(1).front();
    EXPECT_TRUE(problem.space.contains(point)) << problem.name;
    const double f = problem.f(point.values);
    ++found.evaluations;
    if (f < found.f) found = {point.values, f, found.evaluations};
    gss.observe(point, std::isfinite(f) ? Result<Score>(Score{f}) : Failure{"failed"});
  }
  EXPECT_TRUE(gss.converged());
  return found;
}

TEST(GssAmongConstraints, SolvesProblemsOfHockAndSchittkowski) {
  for (const ConstrainedProblem& problem : linearly_constrained_problems()) {
    const Found found = minimize(problem, {.step_tolerance = 1e-4});
    EXPECT_NEAR(found.f, problem.least, 1e-4 * std::max(1.0, std::abs(problem.least)))
        << problem.name;
    for (size_t i = 0; i < found.x.size(); ++i) {
      // A target that is flat at its minimum determines x only to the square root of the target's
      // accuracy.
      EXPECT_NEAR(found.x[i], problem.x[i], 0.02 * std::max(1.0, std::abs(problem.x[i])))
          << problem.name << " x" << i + 1;
    }
    EXPECT_LT(found.evaluations, 600) << problem.name;
    RecordProperty(problem.name, found.evaluations);
  }
}

TEST(GssAmongConstraints, FindsACornerWhereManyPlanesMeet) {
  // A linear target over the cross-polytope |x|_1 <= 1 has its minimum at a corner, where 8 planes
  // meet in four dimensions.
  const int n = 4;
  std::vector<LinearConstraint> rows;
  for (int k = 0; k < 1 << n; ++k) {
    std::vector<double> a;
    for (int i = 0; i < n; ++i) a.push_back((k >> i) & 1 ? -1.0 : 1.0);
    rows.push_back(at_most(a, 1.0));
  }
  const ConstrainedProblem problem{"cross-polytope",
                                   space_of({0.1, -0.2, 0.3, 0.05}, {{-2, 2}}, rows),
                                   [](const auto& x) { return x[0] + 1.2 * x[1] + x[2] + x[3]; },
                                   {0, -1, 0, 0},
                                   -1.2};
  // Exact, because nearby points are moved onto the constraint.
  EXPECT_NEAR(minimize(problem).f, -1.2, 1e-9);
}

TEST(GssAmongConstraints, GoesAroundPointsThatFailAndKinksOnAConstraint) {
  ConstrainedProblem problem = linearly_constrained_problems().front();
  problem.space = space_of({0.1, 0.1, 0.9}, {{0, 1}}, {at_most({1, 1, 0}, 1.2)});
  problem.f = [](const auto& x) {
    if (std::hypot(x[0] - 0.35, x[1] - 0.35, x[2] - 0.6) < 0.1) return std::nan("");
    return std::abs(x[0] - 0.9) + 2 * std::abs(x[1] - 0.8) + std::abs(x[2] - 0.4);
  };
  // The solution is (0.4, 0.8, 0.4): moving along x1 + x2 costs more.
  const Found found = minimize(problem);
  EXPECT_NEAR(found.x[0], 0.4, 5e-3);
  EXPECT_NEAR(found.x[1], 0.8, 5e-3);
  EXPECT_NEAR(found.x[2], 0.4, 5e-3);
}

TEST(GssAmongConstraints, EndsInARegionOfOnePoint) {
  ConstrainedProblem problem{"point",
                             space_of({0.5, 0.5}, {{0, 1}}, {equal({1, 1}, 1), equal({1, -1}, 0)}),
                             [](const auto& x) { return x[0]; },
                             {},
                             0.5};
  EXPECT_EQ(minimize(problem).evaluations, 1);
}

TEST(GssAmongConstraints, FindsItsWayInARegionThinnerThanItsSteps) {
  const ConstrainedProblem problem{
      "thin",
      space_of({0.5, 0.5}, {{0, 1}}, {between({1, 1}, 0.999, 1.002)}),
      [](const auto& x) { return std::pow(x[0] - 0.2, 2) + std::pow(x[1] - 1.5, 2); },
      {0.002, 1},
      0};
  const Found found = minimize(problem);
  EXPECT_NEAR(found.x[0], 0.002, 2e-3);
  EXPECT_NEAR(found.x[1], 1.0, 2e-3);
}

TEST(GssAmongConstraints, DoesNotMoveToAForeignPointOutside) {
  const DesignSpace space = space_of({0.2, 0.2}, {{0, 1}}, {at_most({1, 1}, 1)});
  const auto f = [](const std::vector<double>& x) { return -x[0] - 2 * x[1]; };
  Gss gss(space);
  const DesignSpace cube(space.variables());
  for (const DesignPoint& point : sobol(cube, 64).points)
    gss.observe(point, Score{f(point.values)});
  double least = INFINITY;
  while (!gss.converged()) {
    const DesignPoint point = gss.propose(1).front();
    EXPECT_TRUE(space.contains(point));
    least = std::min(least, f(point.values));
    gss.observe(point, Score{f(point.values)});
  }
  EXPECT_NEAR(least, -2.0, 1e-9);  // the value at the minimum (0, 1)
}

}  // namespace
}  // namespace latsch
