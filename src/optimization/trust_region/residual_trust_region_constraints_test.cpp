// SPDX-License-Identifier: Apache-2.0
// Tests the residual trust region with linear constraints on least-squares problems whose solutions
// are published, by their numbers in [Hock & Schittkowski, Test Examples for Nonlinear Programming
// Codes, Springer 1981].
#include <gtest/gtest.h>

#include <cmath>

#include "optimization/design/sobol.h"
#include "optimization/problem/hock_schittkowski_testing.h"
#include "optimization/trust_region/residual_trust_region.h"

namespace latsch {
namespace {

using Options = ResidualTrustRegionOptions;

struct Found {
  std::vector<double> x;
  double f = INFINITY;
  int evaluations = 0;
};

/// Runs until converged and checks that every proposed point lies inside.
Found minimize(ResidualTrustRegion& method,
               const DesignSpace& space,
               const LeastSquaresProblem::Residuals& residuals) {
  Found found;
  int evaluations = 0;
  while (!method.converged() && evaluations < 500) {
    const DesignPoint point = method.propose(1).front();
    EXPECT_TRUE(space.contains(point));
    const Score score = sum_of_squares(residuals(point.values));
    ++evaluations;
    if (score.value < found.f) found = {point.values, score.value};
    method.observe(point, std::isfinite(score.value) ? Result<Score>(score) : Failure{"failed"});
  }
  EXPECT_TRUE(method.converged());
  found.evaluations = evaluations;
  return found;
}

Found minimize(const DesignSpace& space,
               const LeastSquaresProblem::Residuals& residuals,
               const Options& options = {}) {
  ResidualTrustRegion method(space, options);
  return minimize(method, space, residuals);
}

TEST(TrustRegionAmongConstraints, SolvesProblemsOfHockAndSchittkowski) {
  for (const LeastSquaresProblem& problem : constrained_least_squares_problems()) {
    for (const int outstanding : {1, 4}) {
      const Found found =
          minimize(problem.space,
                   problem.residuals,
                   {.step_tolerance = 1e-6, .restarts = 0, .outstanding = outstanding});
      EXPECT_NEAR(found.f, problem.least, 1e-6 * std::max(1.0, problem.least)) << problem.name;
      for (size_t i = 0; i < found.x.size(); ++i) {
        EXPECT_NEAR(found.x[i], problem.x[i], 2e-3 * std::max(1.0, std::abs(problem.x[i])))
            << problem.name << " x" << i + 1;
      }
      EXPECT_LT(found.evaluations, 100 * outstanding) << problem.name;
    }
  }
}

TEST(TrustRegionAmongConstraints, AnEquationIsWorthAVariable) {
  // A decay A exp(-k t) + c with the constraint A + c = 1 is compared with one in k and c alone,
  // which has the same minimum.
  const auto decay = [](double A, double k, double c) {
    std::vector<double> r;
    for (int i = 0; i < 20; ++i) {
      const double t = 0.1 * i, y = 0.7 * std::exp(-2.0 * t) + 0.25 + 0.01 * std::sin(17.0 * i);
      r.push_back(A * std::exp(-k * t) + c - y);
    }
    return r;
  };
  const Options fine{.step_tolerance = 1e-7, .restarts = 0};
  const Found three = minimize(
      space_of({0.5, 1, 0.5}, {{0, 2}, {0, 5}, {0, 2}}, {equal({1, 0, 1}, 1)}),
      [&](const auto& x) { return decay(x[0], x[1], x[2]); },
      fine);
  const Found two = minimize(
      space_of({1, 0.5}, {{0, 5}, {0, 2}}),
      [&](const auto& x) { return decay(1.0 - x[1], x[0], x[1]); },
      fine);
  EXPECT_NEAR(three.f, two.f, 1e-7 * two.f);
  EXPECT_NEAR(three.x[1], two.x[0], 1e-3);
  EXPECT_NEAR(three.x[0] + three.x[2], 1.0, 1e-9);
  EXPECT_LE(three.evaluations, 2 * two.evaluations);
}

TEST(TrustRegionAmongConstraints, EndsInARegionOfOnePoint) {
  const DesignSpace point = space_of({0.5, 0.5}, {{0, 1}}, {equal({1, 1}, 1), equal({1, -1}, 0)});
  EXPECT_LE(minimize(point, [](const auto& x) { return x; }).evaluations, 2);
}

TEST(TrustRegionAmongConstraints, FindsItsWayInARegionThinnerThanItsSteps) {
  const DesignSpace thin = space_of({0.5, 0.5}, {{0, 1}}, {between({1, 1}, 0.999, 1.002)});
  const Found found = minimize(thin, [](const auto& x) {
    return std::vector<double>{x[0] - 0.2, x[1] - 1.5};
  });
  EXPECT_NEAR(found.x[0], 0.002, 2e-3);
  EXPECT_NEAR(found.x[1], 1.0, 2e-3);
}

TEST(TrustRegionAmongConstraints, LeavesACornerOfManyPlanesAndGoesAroundFailures) {
  // The search starts in the corner (0, 0), from which only directions between the axes and x1 = 2
  // x2 lead inside.
  const DesignSpace wedge =
      space_of({0, 0}, {{0, 1}}, {at_most({1, -2}, 0), at_least({1, -0.5}, 0)});
  const Found found = minimize(wedge, [](const auto& x) {
    if (std::hypot(x[0] - 0.3, x[1] - 0.3) < 0.05) return std::vector<double>{NAN};
    return std::vector<double>{x[0] - 0.7, x[1] - 0.6};
  });
  EXPECT_NEAR(found.x[0], 0.7, 2e-3);
  EXPECT_NEAR(found.x[1], 0.6, 2e-3);
}

TEST(TrustRegionAmongConstraints, LearnsFromForeignPointsOutsideAndStaysInside) {
  const DesignSpace space = space_of({0.2, 0.2}, {{0, 1}}, {at_most({1, 1}, 1)});
  const auto residuals = [](const std::vector<double>& x) {
    return std::vector<double>{x[0] - 0.8, x[1] - 0.8, x[0] * x[1]};
  };
  ResidualTrustRegion method(space, {.step_tolerance = 1e-5});
  for (const DesignPoint& point : sobol(DesignSpace(space.variables()), 32).points) {
    method.observe(point, sum_of_squares(residuals(point.values)));
  }
  // On x1 + x2 = 1 the sum is 2 (x1 - 1/2)^2 + 0.18 + (x1 (1 - x1))^2, with its minimum at 1/2.
  const Found found = minimize(method, space, residuals);
  EXPECT_NEAR(found.x[0], 0.5, 2e-3);
  EXPECT_NEAR(found.x[1], 0.5, 2e-3);
}

}  // namespace
}  // namespace latsch
