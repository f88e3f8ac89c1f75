// SPDX-License-Identifier: Apache-2.0
// Tests of penalties, and of generating-set search with nonlinear constraints.
#include "optimization/direct_search/gss_nlc.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "optimization/problem/hock_schittkowski_testing.h"

namespace latsch {
namespace {

struct Found {
  std::vector<double> x;
  Score score;
  int evaluations = 0;
};

Found minimize(const ConstrainedProblem& problem, const GssNlcOptions& options) {
  GssNlc method(problem.space, options);
  Found found;
  while (!method.converged() && found.evaluations < 20000) {
    const DesignPoint point = method.propose(1).front();
    EXPECT_TRUE(problem.space.contains(point));
    const Score score = score_of(problem, point.values);
    const bool is_finite = std::isfinite(score.value);
    ++found.evaluations;
    if (is_finite && (found.x.empty() || is_better(score, found.score))) {
      found.x = point.values;
      found.score = score;
    }
    method.observe(point, is_finite ? Result<Score>(score) : Failure{"failed"});
  }
  EXPECT_TRUE(method.converged());
  return found;
}

Score violated_by(std::vector<double> c, std::vector<double> h) {
  return {.value = 0.0, .constraints = std::move(c), .equations = std::move(h)};
}

TEST(Penalty, IsTheNormItIsCalledAfter) {
  const Score score = violated_by({3, -7}, {-4});
  EXPECT_DOUBLE_EQ(penalty(Penalty::l2_squared, score, 1.0), 25.0);
  EXPECT_DOUBLE_EQ(penalty(Penalty::l1, score, 1.0), 7.0);
  EXPECT_DOUBLE_EQ(penalty(Penalty::l2, score, 1.0), 5.0);
  EXPECT_DOUBLE_EQ(penalty(Penalty::linf, score, 1.0), 4.0);
  for (const std::string& name : penalty_names()) {
    EXPECT_EQ(latsch::name(penalty_of(name)), name);
    EXPECT_EQ(penalty(penalty_of(name), Score{1.0}, 0.1), 0.0);  // no constraints
  }
}

TEST(Penalty, SmoothedOnesAreAboveTheExactOnesByNoMoreThanTheirBound) {
  // A smoothed penalty exceeds the exact one by at most ln 2 for each term of the sum (l1), ln(1 +
  // number of terms) for the largest violation (linf), and 1 for the norm (l2), times alpha.
  const std::vector<std::pair<Penalty, Penalty>> pairs{{Penalty::l1, Penalty::l1_smoothed},
                                                       {Penalty::l2, Penalty::l2_smoothed},
                                                       {Penalty::linf, Penalty::linf_smoothed}};
  for (const Score& score : {violated_by({3, -7}, {-4}),
                             violated_by({0, 0, 0}, {0, 0}),
                             violated_by({1e-3, -1e3}, {1e3})}) {
    for (const auto& [exact, smoothed] : pairs) {
      for (const double alpha : {1.0, 1e-2, 1e-5}) {
        const double rounding = 1e-12 * (1.0 + penalty(exact, score, alpha));
        const double above = penalty(smoothed, score, alpha) - penalty(exact, score, alpha);
        EXPECT_GE(above, -rounding);
        EXPECT_LE(above, 5 * std::log(2.0) * alpha + rounding);
      }
    }
  }
}

GssNlcOptions as_shipped(double step_tolerance) {
  GssNlcOptions options;
  options.gss.step_tolerance = step_tolerance;
  return options;
}

TEST(GssNlc, SolvesProblemsOfHockAndSchittkowski) {
  for (const ConstrainedProblem& problem : nonlinearly_constrained_problems()) {
    const Found found = minimize(problem, as_shipped(1e-4));
    EXPECT_LE(violation(found.score), kFulfilled) << problem.name;
    // A search whose directions meet curved constraints stops up to half a percent above the
    // minimum.
    EXPECT_NEAR(found.score.value, problem.least, 5e-3 * std::abs(problem.least)) << problem.name;
    EXPECT_LT(found.evaluations, 2500) << problem.name;
    RecordProperty(problem.name, found.evaluations);
  }
}

TEST(GssNlc, EndsInTheFeasibleRegionWithEveryPenalty) {
  for (const std::string& name : penalty_names()) {
    for (const ConstrainedProblem& problem : nonlinearly_constrained_problems()) {
      if (problem.space.size() > 4) continue;
      GssNlcOptions options;
      options.penalty = penalty_of(name);
      const Found found = minimize(problem, options);
      EXPECT_LE(violation(found.score), kFulfilled) << problem.name << " " << name;
      EXPECT_LT(found.score.value, problem.f(problem.space.initial().values) + 40.0);
      EXPECT_GT(found.score.value, problem.least - 0.05) << problem.name << " " << name;
    }
  }
}

TEST(GssNlc, WithoutConstraintsIsTheSearchItself) {
  // Problem HS35, which has a linear constraint.
  ConstrainedProblem problem = linearly_constrained_problems()[3];
  const Found found = minimize(problem, as_shipped(1e-4));
  EXPECT_NEAR(found.score.value, problem.least, 1e-4);
}

TEST(GssNlc, KeepsLinearConstraintsBesideNonlinearOnesAndBearsFailures) {
  // The point of the unit circle nearest to (1, 0.2) with x1 <= x2 is on the diagonal.
  const ConstrainedProblem problem{"circle",
                                   space_of({-0.5, 0.5}, {{-2, 2}}, {at_most({1, -1}, 0)}),
                                   [](const auto& x) -> double {
                                     if (std::hypot(x[0], x[1] - 0.6) < 0.1) return NAN;
                                     return std::pow(x[0] - 1, 2) + std::pow(x[1] - 0.2, 2);
                                   },
                                   {},
                                   0,
                                   {},
                                   {[](const auto& x) { return x[0] * x[0] + x[1] * x[1] - 1; }}};
  const Found found = minimize(problem, {});
  EXPECT_NEAR(found.x[0], std::sqrt(0.5), 0.01);
  EXPECT_NEAR(found.x[1], std::sqrt(0.5), 0.01);
}

TEST(GssNlc, EndsWhereEverythingFailsOrAConstraintIsNotFinite) {
  ConstrainedProblem problem = nonlinearly_constrained_problems()[1];
  problem.f = [](const auto&) { return NAN; };
  EXPECT_TRUE(minimize(problem, {}).x.empty());
  GssNlc method(problem.space);
  int steps = 0;
  for (; !method.converged() && steps < 1000; ++steps) {
    method.observe(method.propose(1).front(), violated_by({NAN}, {}));
  }
  EXPECT_LT(steps, 1000);
}

TEST(GssNlc, AsksForNoPointTwice) {
  const ConstrainedProblem problem = nonlinearly_constrained_problems()[1];
  GssNlc method(problem.space);
  std::set<std::string> asked;
  while (!method.converged()) {
    const auto plan = method.propose(4);
    EXPECT_TRUE(asked.insert(plan.front().bits()).second);
    method.observe(plan.front(), score_of(problem, plan.front().values));
  }
}

TEST(GssNlc, RejectsOptionsOutOfRange) {
  const DesignSpace space = space_of({0.5}, {{0, 1}});
  EXPECT_THROW(GssNlc(space, {.rho = 0.0}), InputError);
  EXPECT_THROW(GssNlc(space, {.rho = 2.0, .largest_rho = 1.0}), InputError);
  EXPECT_THROW(GssNlc(space, {.alpha = 0.0}), InputError);
  EXPECT_THROW(GssNlc(space, {.gss = {.initial_step = 0.0}}), InputError);
}

}  // namespace
}  // namespace latsch
