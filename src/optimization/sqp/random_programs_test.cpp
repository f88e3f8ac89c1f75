// SPDX-License-Identifier: Apache-2.0
// Compares searches with linear constraints with the active-set solution of random programs: linear
// and convex quadratic ones; with integer or real coefficients of the constraints; with planes
// around the start or all through it; with and without an equation.
#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "optimization/direct_search/gss.h"
#include "optimization/problem/feasible_region.h"
#include "optimization/problem/hock_schittkowski_testing.h"
#include "optimization/problem/quadratic_program.h"
#include "optimization/sqp/sqp.h"

namespace latsch {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kPrograms = 80;

struct RandomProgram {
  MatrixXd G;
  VectorXd g;
  std::vector<double> start;
  std::vector<LinearConstraint> rows;

  explicit RandomProgram(int number) {
    RandomStream random(99, number);
    const bool whole = number % 3 == 0, through_start = number % 2 == 1;
    const auto draw = [&](int rows, int cols) {
      MatrixXd M(rows, cols);
      for (double& value : M.reshaped()) value = 2.0 * random.uniform() - 1.0;
      if (whole) M = (1.5 * M).array().round();
      return M;
    };
    const int n = 2 + number % 7;
    const int equations = number % 5 == 0 ? 1 : 0;
    const int count = equations + 1 + static_cast<int>(random.below(2 * n));
    for (int i = 0; i < n; ++i) start.push_back(0.3 + 0.4 * random.uniform());
    for (int k = 0; k < count; ++k) {
      MatrixXd a = draw(1, n);
      if (a.norm() == 0.0) a(0, 0) = 1.0;
      const double sum = a.row(0).dot(Eigen::Map<const VectorXd>(start.data(), n));
      const double room = through_start ? 0.0 : 0.2 * random.uniform();
      const std::vector<double> row(a.data(), a.data() + n);
      rows.push_back(k < equations ? equal(row, sum) : at_most(row, sum + room));
    }
    const MatrixXd R = draw(n, n);
    // If the curvature is tiny, a quadratic program has the solution of a linear one.
    const double least = number % 4 == 0 ? 1e-7 : 0.1;
    G = (number % 4 == 0 ? 0.0 : 1.0) * R.transpose() * R + least * MatrixXd::Identity(n, n);
    g = 3.0 * draw(n, 1);
  }

  double operator()(const VectorXd& x) const { return 0.5 * x.dot(G * x) + g.dot(x); }
};

template <class Method>
double least_found(Method&& method, const DesignSpace& space, const RandomProgram& program) {
  double least = INFINITY;
  for (int k = 0; !method.converged() && k < 6000; ++k) {
    const DesignPoint point = method.propose(1).front();
    EXPECT_TRUE(space.contains(point));
    const double f = program(Eigen::Map<const VectorXd>(point.values.data(), space.size()));
    least = std::min(least, f);
    method.observe(point, Score{f});
  }
  EXPECT_TRUE(method.converged());
  return least;
}

TEST(RandomPrograms, AreSolvedByEveryMethodAlikeWithoutLeavingTheRegion) {
  for (int number = 0; number < kPrograms; ++number) {
    const RandomProgram program(number);
    const DesignSpace space = space_of(program.start, {{0, 1}}, program.rows);
    const FeasibleRegion region(space);
    const QuadraticSolution solution =
        solve({program.G, program.g, region.E(), region.f(), region.A(), region.b()});
    ASSERT_TRUE(solution.is_feasible()) << number;
    const double expected = program(solution.x);
    // The slopes are between 1 and 10, so a search down to a step of 1e-4 ends within about 1e-3 of
    // the minimum.
    EXPECT_NEAR(least_found(Gss(space, {.step_tolerance = 1e-4}), space, program), expected, 2e-3)
        << number;
    EXPECT_NEAR(
        least_found(Sqp(space, {.step_tolerance = 1e-5, .difference = 1e-7}), space, program),
        expected,
        1e-4)
        << number;
  }
}

}  // namespace
}  // namespace latsch
