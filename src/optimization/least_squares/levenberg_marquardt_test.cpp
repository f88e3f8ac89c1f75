// SPDX-License-Identifier: Apache-2.0
// Tests of Levenberg-Marquardt. Problems with certified solutions, and the comparison with SciPy,
// are in verification/nist_strd/levenberg_marquardt_test.cpp.
#include "optimization/least_squares/levenberg_marquardt.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <optional>

#include "base/random.h"
#include "optimization/least_squares/levenberg_marquardt_step.h"
#include "optimization/problem/hock_schittkowski_testing.h"

namespace latsch {
namespace {

using Evaluate = std::function<Result<Score>(const std::vector<double>&)>;
using Values = std::vector<double>;

Score score_of(Values r, Values jacobian) {
  Score score{0.0, std::move(r), std::move(jacobian)};
  for (const double value : score.residuals) score.value += value * value;
  return score;
}

Result<Score> rosenbrock(const Values& x) {
  return score_of({10 * (x[1] - x[0] * x[0]), 1 - x[0]}, {-20 * x[0], 10, -1, 0});
}

/// The residuals are the distance from the point (2, 2), r = x - (2, 2).
Result<Score> distance(const Values& x) { return score_of({x[0] - 2, x[1] - 2}, {1, 0, 0, 1}); }

struct Search {
  Values x;
  double f = INFINITY;
  int evaluations = 0;
  std::string ending = {};
  std::vector<DesignPoint> path = {};
};

Search search(LevenbergMarquardt method, const Evaluate& evaluate, int look_ahead = 1) {
  Search found;
  EXPECT_EQ(method.ending(), "");
  while (!method.converged() && found.evaluations < 500) {
    const DesignPoint point = method.propose(look_ahead).front();
    const Result<Score> outcome = evaluate(point.values);
    ++found.evaluations;
    found.path.push_back(point);
    if (outcome && outcome->value < found.f) found.f = outcome->value, found.x = point.values;
    method.observe(point, outcome);
  }
  found.ending = method.ending();
  return found;
}

TEST(LevenbergMarquardt, SolvesLinearResidualsInOneStep) {
  const Search found =
      search(LevenbergMarquardt(space_of({0, 1}, {{-5, 5}}), {.initial_step = 1.0}), distance);
  EXPECT_EQ(found.evaluations, 2);
  EXPECT_NEAR(found.x[0], 2.0, 1e-14);
  EXPECT_NEAR(found.x[1], 2.0, 1e-14);
}

// The residual r = ln(x / 3) is linear in ln x, and x is searched on a logarithmic scale.
TEST(LevenbergMarquardt, SearchesLogarithmicVariablesInTheirLogarithm) {
  const DesignSpace space(
      {{.name = "x", .lower = 0.01, .upper = 100.0, .initial = 50.0, .scale = Scale::logarithmic}});
  const Search found =
      search(LevenbergMarquardt(space, {.initial_step = 1.0}),
             [](const Values& x) { return score_of({std::log(x[0] / 3)}, {1 / x[0]}); });
  EXPECT_EQ(found.evaluations, 2);
  EXPECT_NEAR(found.x[0], 3.0, 1e-13);
}

// The valley ends at (1, 1), as Moré, Garbow and Hillstrom state.
TEST(LevenbergMarquardt, FollowsACurvedValley) {
  const Search found = search(LevenbergMarquardt(space_of({-1.2, 1}, {{-5, 5}})), rosenbrock);
  EXPECT_NEAR(found.x[0], 1.0, 1e-6);
  EXPECT_NEAR(found.x[1], 1.0, 1e-6);
  EXPECT_LE(found.evaluations, 25);
  EXPECT_THAT(
      found.ending,
      testing::AnyOf(testing::HasSubstr("at a minimum"), testing::HasSubstr("nothing left")));
}

constexpr double kNarrow = 0.01;

double angle(const Values& x) { return std::atan2(x[1], x[0]); }

/// The target has a valley along the circle of radius 1. On its floor the value is phi^2 at the
/// angle phi, with the minimum 0 at (1, 0).
Result<Score> bent_valley(const Values& x) {
  const double rho = std::hypot(x[0], x[1]), phi = angle(x);
  const double c = x[0] / rho, s = x[1] / rho;
  return score_of({(rho - 1.0) / kNarrow, phi}, {c / kNarrow, s / kNarrow, -s / rho, c / rho});
}

/// Counts the steps that end on the side of the valley and after which the next step ends still
/// further along the valley, but ten times nearer to its floor.
int returns(const Search& found) {
  const auto off = [](const Values& x) { return std::abs(std::hypot(x[0], x[1]) - 1.0); };
  int count = 0;
  double best = INFINITY;
  for (std::size_t k = 0; k + 1 < found.path.size(); ++k) {
    const Values &here = found.path[k].values, &next = found.path[k + 1].values;
    const double f = bent_valley(here)->value;
    count += f > best && off(next) < 0.1 * off(here) && angle(next) < angle(here) + 0.01;
    best = std::min(best, f);
  }
  return count;
}

// A step p along the tangent of the circle ends p^2/2 away from the floor, so it decreases the
// target only up to p^3 = 8 kNarrow^2 phi: to p = 0.13 at phi = 3, where the minimum is 3 away.
// Steps corrected for curvature go further, and returns to the floor make still longer ones useful:
// a quarter fewer evaluations in all.
TEST(LevenbergMarquardt, ReturnsToTheFloorOfABentValley) {
  int evaluations[2] = {}, returned[2] = {};
  for (const double start : {1.0, 1.5, 2.0, 2.5, 3.0}) {
    for (const int with : {0, 1}) {
      const Search found =
          search(LevenbergMarquardt(space_of({std::cos(start), std::sin(start)}, {{-2, 2}}),
                                    {.most_returns = with ? 6 : 0}),
                 bent_valley);
      EXPECT_NEAR(found.x[0], 1.0, 1e-4) << start;
      EXPECT_NEAR(found.x[1], 0.0, 1e-4) << start;
      evaluations[with] += found.evaluations;
      returned[with] += returns(found);
    }
  }
  EXPECT_EQ(returned[0], 0);
  EXPECT_GT(returned[1], 0);
  // This count includes the evaluations of the returns.
  EXPECT_LT(4 * evaluations[1], 3 * evaluations[0]);
}

// Rosenbrock's function with x0 <= 1/2: x1 = x0^2 makes the first residual 0, and 1 - x0 is least
// at the bound.
TEST(LevenbergMarquardt, EndsAtABoundThatHoldsIt) {
  const Search found =
      search(LevenbergMarquardt(space_of({-1.2, 1}, {{-5, 0.5}, {-5, 5}})), rosenbrock);
  EXPECT_EQ(found.x[0], 0.5);
  EXPECT_NEAR(found.x[1], 0.25, 1e-6);
  EXPECT_NEAR(found.f, 0.25, 1e-9);
  EXPECT_THAT(found.ending, testing::HasSubstr("at a minimum"));
}

// The start is on bounds that the search has to leave.
TEST(LevenbergMarquardt, LeavesBoundsItStartsOn) {
  const Search found = search(LevenbergMarquardt(space_of({-5, 5}, {{-5, 5}})), distance);
  EXPECT_NEAR(found.x[0], 2.0, 1e-9);
  EXPECT_NEAR(found.x[1], 2.0, 1e-9);
}

// The solutions are the points of x0 + x1 <= 1 and of x0 - x1 = 1 that are nearest to (2, 2).
TEST(LevenbergMarquardt, KeepsLinearConstraints) {
  const Search below =
      search(LevenbergMarquardt(space_of({-3, 1}, {{-5, 5}}, {at_most({1, 1}, 1)})), distance);
  EXPECT_NEAR(below.x[0], 0.5, 1e-6);
  EXPECT_NEAR(below.x[1], 0.5, 1e-6);
  const Search on =
      search(LevenbergMarquardt(space_of({1, 0}, {{-5, 5}}, {equal({1, -1}, 1)})), distance);
  EXPECT_NEAR(on.x[0], 2.5, 1e-6);
  EXPECT_NEAR(on.x[1], 1.5, 1e-6);
}

// Rosenbrock's function on x1 = 1 - x0 is (10 (1 - x - x^2))^2 + (1 - x)^2. Newton's method finds
// the zero of its slope -200 (1 - x - x^2) (1 + 2 x) - 2 (1 - x).
TEST(LevenbergMarquardt, FindsAMinimumAlongAnEquation) {
  double x = 0.6;
  for (int k = 0; k < 20; ++k) {
    const double r = 1 - x - x * x, slope = -200 * r * (1 + 2 * x) - 2 * (1 - x);
    x -= slope / (200 * (1 + 2 * x) * (1 + 2 * x) - 400 * r + 2);
  }
  const Search found =
      search(LevenbergMarquardt(space_of({0.3, 0.7}, {{-5, 5}}, {equal({1, 1}, 1)})), rosenbrock);
  EXPECT_NEAR(found.x[0], x, 1e-5);
  EXPECT_NEAR(found.x[1], 1 - x, 1e-5);
}

// Trials beyond x0 + x1 = 2.2 fail. The minimum (1, 1) lies in the part where they succeed, so
// steps are only shortened.
TEST(LevenbergMarquardt, GoesAroundFailures) {
  int failures = 0;
  const Search found = search(LevenbergMarquardt(space_of({-1.2, 1}, {{-5, 5}})),
                              [&](const Values& x) -> Result<Score> {
                                if (x[0] + x[1] > 2.2 || x[1] < 0.0) {
                                  ++failures;
                                  return Failure{"no equilibrium"};
                                }
                                return rosenbrock(x);
                              });
  EXPECT_GT(failures, 0);
  EXPECT_NEAR(found.x[0], 1.0, 1e-6);
  EXPECT_NEAR(found.x[1], 1.0, 1e-6);
}

TEST(LevenbergMarquardt, EndsAtAnEdgeOfFailures) {
  const Search found =
      search(LevenbergMarquardt(space_of({0, 1}, {{-5, 5}})), [](const Values& x) -> Result<Score> {
        if (x[0] + x[1] > 2.2) return Failure{"no equilibrium"};
        return distance(x);
      });
  EXPECT_THAT(found.ending, testing::HasSubstr("edge of failed trials"));
}

TEST(LevenbergMarquardt, MovesAStartThatFailsAndGivesUpWhereAllDo) {
  const Search found = search(LevenbergMarquardt(space_of({-4.9, -4.9}, {{-5, 5}})),
                              [](const Values& x) -> Result<Score> {
                                if (x[0] + x[1] < -6.0) return Failure{"no equilibrium"};
                                return distance(x);
                              });
  EXPECT_NEAR(found.x[0], 2.0, 1e-6);
  const Search none = search(LevenbergMarquardt(space_of({-4.9, -4.9}, {{-5, 5}})),
                             [](const Values&) -> Result<Score> { return Failure{"no mesh"}; });
  EXPECT_THAT(none.ending, testing::HasSubstr("every trial failed"));
}

TEST(LevenbergMarquardt, RefusesScoresWithoutResidualsOrDerivativesInWords) {
  const auto complaint = [](const Score& score) -> std::string {
    LevenbergMarquardt method(space_of({0, 1}, {{-5, 5}}));
    try {
      method.observe(method.propose(1).front(), score);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(complaint({1.0}), testing::HasSubstr("gives no residuals"));
  EXPECT_THAT(complaint({1.0, {1.0}}), testing::HasSubstr("without their derivatives"));
  EXPECT_EQ(complaint({1.0, {1.0}, {0.0, 1.0}}), "");
}

// The derivatives have the wrong sign, so no step in the direction of descent decreases the target.
TEST(LevenbergMarquardt, SaysWhereDerivativesAreWrong) {
  const Search found = search(LevenbergMarquardt(space_of({0, 1}, {{-5, 5}})), [](const Values& x) {
    return score_of({x[0] - 2, x[1] - 2}, {-1, 0, 0, -1});
  });
  EXPECT_THAT(found.ending, testing::HasSubstr("these are wrong"));
}

// Trials are solved only to 3e-6. The minimum of the target is zero, so the search ends when only
// this scatter is left, which the derivatives do not contain.
TEST(LevenbergMarquardt, SaysThatNothingButScatterIsLeft) {
  const LevenbergMarquardtOptions fine{.step_tolerance = 1e-9};
  const Search found =
      search(LevenbergMarquardt(space_of({0, 1}, {{-5, 5}}), fine), [](const Values& x) {
        const double scatter = 3e-6 * std::sin(1e9 * (x[0] + x[1]));
        return score_of({x[0] - 2 + scatter, x[1] - 2, 0.3 * scatter}, {1, 0, 0, 1, 0, 0});
      });
  EXPECT_LT(found.f, 1e-10);
  EXPECT_THAT(found.ending, testing::HasSubstr("nothing left"));
}

TEST(LevenbergMarquardt, GoesTheSameWayWhateverTheLookAhead) {
  const LevenbergMarquardtOptions options{.initial_step = 0.02};
  const DesignSpace space = space_of({-1.2, 1}, {{-5, 5}});
  const Search one = search(LevenbergMarquardt(space, options), rosenbrock, 1);
  const Search many = search(LevenbergMarquardt(space, options), rosenbrock, 7);
  EXPECT_EQ(one.path, many.path);
}

// The point after a success cannot be guessed exactly to the last bit; the point after a failure is
// known.
TEST(LevenbergMarquardt, LooksAheadOfFailuresAloneWithoutChangingItsMind) {
  LevenbergMarquardt method(space_of({-1.2, 1}, {{-5, 5}}), {.initial_step = 0.02});
  method.observe(method.propose(1).front(), rosenbrock({-1.2, 1}));
  EXPECT_EQ(method.propose(6).size(), 1u);
  method.observe(method.propose(1).front(), Failure{"no equilibrium"});
  const auto plan = method.propose(6);
  EXPECT_EQ(plan.size(), 6u);
  EXPECT_EQ(plan, method.propose(6));
  for (std::size_t i = 1; i < plan.size(); ++i) {
    EXPECT_EQ(method.propose(1).front(), plan[i - 1]);
    method.observe(plan[i - 1], Failure{"no equilibrium"});
  }
}

TEST(LevenbergMarquardt, TakesOverABetterPointOfOthers) {
  LevenbergMarquardt method(space_of({-1.2, 1}, {{-5, 5}}));
  method.observe({{1.01, 1.02}}, rosenbrock({1.01, 1.02}));
  const DesignPoint start = method.propose(1).front();
  method.observe(start, rosenbrock(start.values));
  const DesignPoint next = method.propose(1).front();
  EXPECT_NEAR(next.values[0], 1.0, 0.02);
  EXPECT_NEAR(next.values[1], 1.0, 0.02);
}

TEST(LevenbergMarquardt, RefusesOptionsOutOfRange) {
  const DesignSpace space = space_of({0, 1}, {{-5, 5}});
  EXPECT_THROW(LevenbergMarquardt(space, {.initial_step = 0.0}), InputError);
  EXPECT_THROW(LevenbergMarquardt(space, {.initial_step = 0.1, .step_tolerance = 0.2}), InputError);
}

// With J = 1 the step is -r, shortened to the radius Delta by mu = |r| / Delta - 1.
TEST(LevenbergMarquardtSteps, AreAsLongAsTheRadius) {
  const Eigen::Vector2d r(0.3, -0.4), one = Eigen::Vector2d::Ones();
  const FeasibleRegion cube(space_of({0.5, 0.5}, {{0, 1}}));
  const LevenbergMarquardtSteps steps(
      r, Eigen::Matrix2d::Identity(), one, Eigen::Vector2d(0.5, 0.5), cube);
  EXPECT_NEAR(steps.full().promised, 0.25, 1e-15);
  const LevenbergMarquardtStep step = steps.within(0.1);
  EXPECT_NEAR(step.length, 0.1, 0.01);
  EXPECT_NEAR(step.p.dot(-r), step.length * r.norm(), 1e-15);
  EXPECT_NEAR(1.0 + step.mu, r.norm() / step.length, 1e-12);
}

// A constraint that is not active changes a step inside the bounds only by the curvature of 1e-12
// that the quadratic program adds.
TEST(LevenbergMarquardtSteps, AreTheSameAmongConstraintsThatDoNotMatter) {
  const Eigen::MatrixXd J{{3, 1}, {-1, 2}, {0.5, 0.25}};
  const Eigen::Vector3d r(1, -2, 0.5);
  const Eigen::Vector2d D(4, 2), u(0.2, 0.9);
  const FeasibleRegion cube(space_of({0.2, 0.9}, {{0, 1}}));
  const FeasibleRegion cut(space_of({0.2, 0.9}, {{0, 1}}, {at_most({1, 1}, 1.99)}));
  for (const double mu_of_radius : {0.05, 0.2, 10.0}) {
    const auto a = LevenbergMarquardtSteps(r, J, D, u, cube).within(mu_of_radius);
    const auto b = LevenbergMarquardtSteps(r, J, D, u, cut).within(mu_of_radius);
    EXPECT_NEAR((a.p - b.p).norm(), 0.0, 1e-9) << mu_of_radius;
  }
}

// The target is a winding valley, y = sin(6 x) / 2, whose floor falls by 0.18 in all. The noise of
// 400 values, standard deviation 1, leaves a much larger uncertainty of the target. The search
// starts high above the floor and may end on it: the fall that is left is less than half a standard
// deviation and not worth further steps.
TEST(LevenbergMarquardt, LeavesAValleyWhoseFloorFallsLessThanNoise) {
  const DesignSpace space({{.name = "x", .lower = -3.0, .upper = 3.0, .initial = -2.2},
                           {.name = "y", .lower = -3.0, .upper = 3.0, .initial = 1.0}});
  const auto valley = [](const DesignPoint& p) {
    const double x = p.values[0], y = p.values[1];
    Score score{.residuals = {1e4 * (y - 0.5 * std::sin(6.0 * x)), 0.1 * (2.0 - x)},
                .jacobian = {-3e4 * std::cos(6.0 * x), 1e4, -0.1, 0.0}};
    for (int i = 0; i < 400; ++i) {
      score.residuals.push_back(1.0);
      score.jacobian.insert(score.jacobian.end(), {0.0, 0.0});
    }
    for (const double r : score.residuals) score.value += r * r;
    return score;
  };
  const auto run = [&](double progress) {
    LevenbergMarquardt search(space, {.progress_tolerance = progress});
    std::pair<int, double> steps_and_least{0, INFINITY};
    while (!search.converged() && steps_and_least.first < 1000) {
      const DesignPoint point = search.propose(1).front();
      const Score score = valley(point);
      search.observe(point, score);
      ++steps_and_least.first;
      steps_and_least.second = std::min(steps_and_least.second, score.value);
    }
    EXPECT_TRUE(search.converged());
    return steps_and_least;
  };
  const auto whole = run(0.0), short_of_noise = run(1.0 / 402.0);
  EXPECT_LT(2 * short_of_noise.first, whole.first);
  EXPECT_LT(short_of_noise.second - whole.second, 0.18);
}

// A Gauss-Newton step that is cut off by bounds may lead uphill although it is short. A shorter
// step that decreases the target has to be found, however large the radius is.
TEST(LevenbergMarquardtSteps, PromiseSomethingWhereverTheSlopeDoes) {
  RandomStream random(11, 0);
  int spoiled = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    constexpr int n = 4;
    Eigen::MatrixXd J(8, n);
    for (double& x : J.reshaped()) x = random.normal();
    for (int i = 1; i < n; ++i) J.col(i) = J.col(0) + 0.05 * J.col(i);  // nearly parallel
    Eigen::VectorXd r(8), u(n);
    for (double& x : r) x = random.normal();
    std::vector<DesignVariable> variables;
    for (int i = 0; i < n; ++i) {
      u[i] = random.uniform() < 0.5 ? 1e-3 * random.uniform() : random.uniform();
      variables.push_back({.name = std::string(1, static_cast<char>('a' + i))});
    }
    const LevenbergMarquardtSteps steps(
        r, J, J.colwise().norm().transpose(), u, FeasibleRegion(DesignSpace(variables)));
    if (!(steps.promised_by_one() > 1e-6 * r.squaredNorm())) continue;
    spoiled += steps.full().promised <= 0.0;
    EXPECT_GT(steps.within(100.0).promised, 0.0) << trial;
  }
  EXPECT_GT(spoiled, 10);
}

}  // namespace
}  // namespace latsch
