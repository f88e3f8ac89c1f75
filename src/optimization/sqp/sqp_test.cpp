// SPDX-License-Identifier: Apache-2.0
#include "optimization/sqp/sqp.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "optimization/problem/hock_schittkowski_testing.h"
#include "optimization/region/difference_directions.h"
#include "optimization/sqp/damped_bfgs.h"

namespace latsch {
namespace {

struct Found {
  std::vector<double> x;
  Score score;
  int evaluations = 0;
};

Found minimize(const ConstrainedProblem& problem, const SqpOptions& options = {}) {
  Sqp sqp(problem.space, options);
  Found found;
  while (!sqp.converged() && found.evaluations < 5000) {
    const auto plan = sqp.propose(5);
    const DesignPoint point = sqp.propose(1).front();
    EXPECT_EQ(plan.front(), point);
    EXPECT_TRUE(problem.space.contains(point)) << problem.name;
    const Score score = score_of(problem, point.values);
    const bool is_finite = std::isfinite(score.value);
    ++found.evaluations;
    if (is_finite && (found.x.empty() || is_better(score, found.score))) {
      found.x = point.values;
      found.score = score;
    }
    sqp.observe(point, is_finite ? Result<Score>(score) : Failure{"failed"});
  }
  EXPECT_TRUE(sqp.converged());
  return found;
}

const SqpOptions kExact{.step_tolerance = 1e-5, .difference = 1e-7};

TEST(DampedBfgs, FulfillsTheSecantEquationAndStaysPositiveDefinite) {
  const Eigen::Vector2d s(1, 2), uphill(3, 1), downhill(-3, -1);
  const Eigen::Matrix2d B = 5.0 * Eigen::Matrix2d::Identity();
  EXPECT_LT((damped_bfgs(B, s, 4.0 * uphill, false) * s - 4.0 * uphill).norm(), 1e-14);
  for (const Eigen::Vector2d& y : {downhill, Eigen::Vector2d(0, 0), Eigen::Vector2d(1e-9, 0)}) {
    const Eigen::MatrixXd next = damped_bfgs(B, s, y, false);
    EXPECT_GT(next.determinant(), 0.0);
    // 0.2 is the smallest share of the curvature that B keeps.
    EXPECT_NEAR(s.dot(next * s), 0.2 * s.dot(B * s), 1e-12);
  }
}

TEST(DifferenceDirections, AreIndependentAndStayInside) {
  // At the vertex (1, 0, 0) of the triangle x1 + x2 + x3 = 1, x >= 0, two independent feasible
  // directions remain.
  const FeasibleRegion triangle(space_of({1, 0, 0}, {{0, 1}}, {equal({1, 1, 1}, 1)}));
  const Eigen::Vector3d corner(1, 0, 0);
  const Eigen::MatrixXd D = difference_directions(triangle, corner, 1e-4);
  ASSERT_EQ(D.cols(), 2);
  EXPECT_GT((D.transpose() * D).determinant(), 0.1);
  for (int k = 0; k < 2; ++k) EXPECT_TRUE(triangle.contains(corner + 1e-4 * D.col(k)));
  const FeasibleRegion cube(space_of({1, 0.4}, {{0, 1}}));
  const Eigen::MatrixXd axes = difference_directions(cube, Eigen::Vector2d(1, 0.4), 1e-4);
  EXPECT_EQ(axes, Eigen::MatrixXd(Eigen::Vector2d(-1, 1).asDiagonal()));
}

TEST(Sqp, SolvesProblemsOfHockAndSchittkowski) {
  auto problems = linearly_constrained_problems();
  for (auto& problem : nonlinearly_constrained_problems()) problems.push_back(problem);
  for (const ConstrainedProblem& problem : problems) {
    const Found found = minimize(problem, kExact);
    EXPECT_LE(violation(found.score), kFulfilled) << problem.name;
    // A constraint may be violated by kFulfilled, which lowers the target by kFulfilled times the
    // constraint's multiplier, at most about 5.
    EXPECT_NEAR(found.score.value, problem.least, 5e-4 + 1e-6 * std::abs(problem.least))
        << problem.name;
    for (size_t i = 0; i < found.x.size(); ++i) {
      EXPECT_NEAR(found.x[i], problem.x[i], 2e-3) << problem.name << " x" << i + 1;
    }
    EXPECT_LT(found.evaluations, 150) << problem.name;
    RecordProperty(problem.name, found.evaluations);
  }
}

TEST(Sqp, NeedsFewestEvaluationsWhereItKnowsResidualsAndTheirDerivatives) {
  // Rosenbrock's valley as residuals, restricted to half a circle of radius 1.2 around the origin.
  const DesignSpace space = space_of({-1.2, 1.0}, {{-2, 2}});
  for (const bool has_jacobian : {false, true}) {
    Sqp sqp(space, {.initial_step = 0.5, .step_tolerance = 1e-5, .difference = 1e-7});
    Score best{INFINITY};
    int evaluations = 0;
    for (; !sqp.converged() && evaluations < 500; ++evaluations) {
      const DesignPoint point = sqp.propose(1).front();
      const double a = point.values[0], b = point.values[1];
      Score score{0.0, {10 * (b - a * a), 1 - a}};
      if (has_jacobian) score.jacobian = {-20 * a, 10, -1, 0};
      score.value = std::pow(score.residuals[0], 2) + std::pow(score.residuals[1], 2);
      if (is_better(score, best)) best = score;
      sqp.observe(point, score);
    }
    EXPECT_LT(best.value, 1e-8);
    EXPECT_LT(evaluations, has_jacobian ? 25 : 60);
    RecordProperty(has_jacobian ? "with_jacobian" : "without", evaluations);
  }
}

TEST(Sqp, RelaxesConstraintsWhoseLinearizationsCannotBeFulfilled) {
  // The constraint is x^2 >= 1. At the start 0.1 its tangent requires a step of 5, but the longest
  // step is 0.4.
  const ConstrainedProblem problem{"far",
                                   space_of({0.1}, {{-2, 2}}),
                                   [](const auto& x) { return x[0] * x[0]; },
                                   {1},
                                   1,
                                   {[](const auto& x) { return 1 - x[0] * x[0]; }}};
  EXPECT_NEAR(minimize(problem, kExact).x[0], 1.0, 1e-4);
}

TEST(Sqp, FindsItsWayWherePointsFail) {
  int solved = 0;
  for (int seed = 0; seed < 20; ++seed) {
    ConstrainedProblem problem = nonlinearly_constrained_problems()[1];  // HS65
    const auto f = problem.f;
    problem.f = [f, seed](const std::vector<double>& x) {
      const double dice = std::sin(1e4 * (x[0] + 2 * x[1] + 3 * x[2]) + seed);
      return dice > 0.9 ? NAN : f(x);  // a seventh of all points fail
    };
    solved += minimize(problem, kExact).score.value < problem.least + 1e-2;
  }
  EXPECT_GE(solved, 18);
}

TEST(Sqp, MovesAStartThatFailsTowardTheMiddleAndEndsWhereEverythingFails) {
  ConstrainedProblem problem = linearly_constrained_problems()[3];  // HS35
  const auto f = problem.f;
  problem.f = [f](const auto& x) { return x[0] == 0.5 ? NAN : f(x); };
  EXPECT_NEAR(minimize(problem, kExact).score.value, problem.least, 1e-4);
  problem.f = [](const auto&) { return NAN; };
  EXPECT_EQ(minimize(problem).evaluations, 1 + 4);
}

TEST(Sqp, TakesOverABetterPointOfOthers) {
  const ConstrainedProblem problem = nonlinearly_constrained_problems()[3];  // HS100
  Sqp sqp(problem.space, kExact);
  sqp.observe(sqp.propose(1).front(), score_of(problem, problem.space.initial().values));
  sqp.observe({problem.x}, score_of(problem, problem.x));
  double least = INFINITY;
  int evaluations = 0;
  for (; !sqp.converged() && evaluations < 60; ++evaluations) {
    const DesignPoint point = sqp.propose(1).front();
    const Score score = score_of(problem, point.values);
    if (violation(score) <= kFulfilled) least = std::min(least, score.value);
    sqp.observe(point, score);
  }
  EXPECT_NEAR(least, problem.least, 1e-2);
}

TEST(Sqp, TakesOverNoPointThatTellsOfOtherConstraints) {
  const ConstrainedProblem problem = nonlinearly_constrained_problems()[1];  // HS65
  Sqp sqp(problem.space, kExact);
  sqp.observe({problem.x}, Score{-1000.0});
  double least = INFINITY;
  while (!sqp.converged()) {
    const DesignPoint point = sqp.propose(1).front();
    const Score score = score_of(problem, point.values);
    if (violation(score) <= kFulfilled) least = std::min(least, score.value);
    sqp.observe(point, score);
  }
  EXPECT_NEAR(least, problem.least, 5e-4);
}

TEST(Sqp, SpeculatesOnDifferencesAtTheEndOfTheStep) {
  const ConstrainedProblem problem = linearly_constrained_problems()[3];
  Sqp sqp(problem.space, kExact);
  int came_true = 0, steps = 0;
  std::vector<DesignPoint> speculation;
  for (; !sqp.converged(); ++steps) {
    const auto plan = sqp.propose(8);
    came_true +=
        std::find(speculation.begin(), speculation.end(), plan.front()) != speculation.end();
    if (plan.size() > 1) speculation.assign(plan.begin() + 1, plan.end());
    sqp.observe(plan.front(), score_of(problem, plan.front().values));
  }
  EXPECT_GT(came_true, steps / 2);
}

TEST(Sqp, RejectsOptionsOutOfRange) {
  const DesignSpace space = space_of({0.5}, {{0, 1}});
  EXPECT_THROW(Sqp(space, {.initial_step = 0.0}), InputError);
  EXPECT_THROW(Sqp(space, {.step_tolerance = 0.5}), InputError);
  EXPECT_THROW(Sqp(space, {.difference = 0.01}), InputError);
}

TEST(Sqp, TakesDifferencesWhereTheJacobianIsNotFinite) {
  const DesignSpace space = space_of({0.2, 0.9}, {{0, 1}});
  Sqp sqp(space, kExact);
  double least = INFINITY;
  int evaluations = 0;
  for (; !sqp.converged() && evaluations < 200; ++evaluations) {
    const DesignPoint point = sqp.propose(1).front();
    const auto& x = point.values;
    Score score{0.0, {std::exp(x[0]) - 1.5, x[1] - 0.3, 0.1 * x[0] * x[1]}};
    for (const double r : score.residuals) score.value += r * r;
    score.jacobian = {std::exp(x[0]), 0.0, 0.0, NAN, 0.1 * x[1], 0.1 * x[0]};
    least = std::min(least, score.value);
    EXPECT_TRUE(std::isfinite(x[0]) && std::isfinite(x[1]));
    sqp.observe(point, score);
  }
  EXPECT_TRUE(sqp.converged());
  // A search that uses only differences would end at (0.405, 0.3), apart from the effect of the
  // small third residual.
  EXPECT_LT(least, 2e-4);
}

}  // namespace
}  // namespace latsch
