// SPDX-License-Identifier: Apache-2.0
// Tests of Nelder-Mead, of the genetic algorithm and of the choice of a method.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "optimization/strategy/optimizer_choice.h"

namespace latsch {
namespace {

using Function = std::function<double(const std::vector<double>&)>;

DesignSpace box(const std::vector<double>& initial, double lower, double upper) {
  std::vector<DesignVariable> variables;
  for (const double x : initial) {
    variables.push_back({.name = fmt::format("x{}", variables.size()),
                         .lower = lower,
                         .upper = upper,
                         .initial = x});
  }
  return DesignSpace(variables);
}

struct Found {
  std::vector<double> x;
  double f = INFINITY;
  int evaluations = 0;
};

Found minimize(Optimizer& method, const DesignSpace& space, const Function& function) {
  Found found;
  while (!method.converged() && found.evaluations < 20000) {
    const std::vector<DesignPoint> plan = method.propose(4);
    const DesignPoint point = method.propose(1).front();
    EXPECT_EQ(plan.front(), point);
    EXPECT_TRUE(space.contains(point));
    const double f = function(point.values);
    ++found.evaluations;
    if (f < found.f) found = {point.values, f, found.evaluations};
    method.observe(point, std::isfinite(f) ? Result<Score>(Score{f}) : Failure{"failed"});
  }
  EXPECT_TRUE(method.converged());
  return found;
}

double rosenbrock(const std::vector<double>& x) {
  return 100.0 * std::pow(x[1] - x[0] * x[0], 2) + std::pow(1.0 - x[0], 2);
}

/// Rastrigin's function of n variables, which has many local minima; the global one is shifted to
/// 0.3 [Rastrigin 1974].
double rastrigin(const std::vector<double>& x) {
  double f = 0.0;
  for (const double c : x) {
    const double d = c - 0.3;
    f += 10.0 + d * d - 10.0 * std::cos(2.0 * M_PI * d);
  }
  return f;
}

TEST(NelderMead, FollowsRosenbrocksValley) {
  const DesignSpace space = box({-1.2, 1.0}, -2.0, 2.0);
  NelderMead method(space, {.step_tolerance = 1e-5});
  const Found found = minimize(method, space, rosenbrock);
  EXPECT_NEAR(found.x[0], 1.0, 1e-3);
  EXPECT_NEAR(found.x[1], 1.0, 1e-3);
  EXPECT_LT(found.evaluations, 300);
}

TEST(NelderMead, EndsAtABoundAndBesideFailures) {
  const DesignSpace space = box({0.3, 0.6}, 0.0, 1.0);
  NelderMead method(space);
  const Found found = minimize(method, space, [](const auto& x) {
    return x[1] > 0.8 ? std::nan("") : std::pow(x[0] - 2.0, 2) + std::pow(x[1] - 0.7, 2);
  });
  EXPECT_NEAR(found.x[0], 1.0, 1e-3);
  EXPECT_NEAR(found.x[1], 0.7, 5e-3);
}

TEST(Genetic, FindsTheDeepestOfManyBasins) {
  const DesignSpace space = box({4.0, -4.0}, -5.0, 5.0);
  Genetic method(space, {.population = 60});
  const Found found = minimize(method, space, rastrigin);
  // The value at the next local minimum is about 1.
  EXPECT_LT(found.f, 0.5);
}

TEST(Genetic, IsTheSameRunTwiceAndAnotherWithAnotherSeed) {
  const DesignSpace space = box({4.0, -4.0}, -5.0, 5.0);
  Genetic a(space, {.generations = 5}), b(space, {.generations = 5});
  Genetic c(space, {.generations = 5, .seed = 2});
  const Found first = minimize(a, space, rastrigin);
  EXPECT_EQ(first.x, minimize(b, space, rastrigin).x);
  EXPECT_NE(first.x, minimize(c, space, rastrigin).x);
}

TEST(DirectMethods, EndWhereEverythingFails) {
  const DesignSpace space = box({0.5, 0.5}, 0.0, 1.0);
  NelderMead simplex(space);
  Genetic genetic(space);
  const auto nothing = [](const auto&) { return std::nan(""); };
  EXPECT_EQ(minimize(simplex, space, nothing).f, INFINITY);
  EXPECT_EQ(minimize(genetic, space, nothing).f, INFINITY);
}

TEST(MethodChoice, GoesByWhatIsKnownAndSaysWhy) {
  EXPECT_EQ(choose_method({.variables = 5, .has_residuals = true}).method,
            Method::residual_trust_region);
  EXPECT_EQ(choose_method({.has_residuals = true, .has_jacobian = true}).method,
            Method::levenberg_marquardt);
  EXPECT_EQ(choose_method({.has_residuals = true,
                           .has_jacobian = true,
                           .has_linear_constraints = true,
                           .has_nonlinear_constraints = true})
                .method,
            Method::sqp);
  EXPECT_EQ(choose_method({.variables = 5}).method, Method::gss);
  EXPECT_EQ(choose_method({.variables = 2, .basins = 3}).method, Method::genetic);
  const MethodChoice failing = choose_method({.has_residuals = true, .failed_share = 0.7});
  EXPECT_EQ(failing.method, Method::gss);
  EXPECT_NE(failing.reason.find("70 %"), std::string::npos);
}

OptimizerSettings settings_of(const std::string& method) {
  OptimizerSettings settings;
  settings.method = method;
  return settings;
}

TEST(MethodChoice, MakesEveryMethodAndRefusesOthers) {
  const DesignSpace space = box({0.5, 0.5}, 0.0, 1.0);
  for (const std::string& name : method_names()) {
    const MethodChoice choice = method_of(settings_of(name), {.variables = 2});
    OptimizerSettings settings;
    settings.members = {{"one", 1, {}}};
    EXPECT_EQ(make_optimizer(choice.method, space, settings)->propose(1).front(), space.initial());
  }
  EXPECT_THROW(method_of(settings_of("simplex"), {}), InputError);
}

TEST(MethodChoice, KnowsWhoKnowsConstraints) {
  const LinearConstraint sum{.name = "sum", .coefficients = {1, 1}, .upper = 1.5};
  const DesignSpace space(box({0.5, 0.5}, 0.0, 1.0).variables(), {sum});
  EXPECT_NO_THROW(make_optimizer(Method::nelder_mead, space, {}));
  const ProblemTraits linear{.has_residuals = true, .has_linear_constraints = true};
  EXPECT_EQ(choose_method(linear).method, Method::residual_trust_region);
  const ProblemTraits nonlinear{.has_residuals = true, .has_nonlinear_constraints = true};
  EXPECT_EQ(choose_method(nonlinear).method, Method::sqp);
  EXPECT_THROW(make_optimizer(Method::nelder_mead, space, {}, nonlinear), InputError);
  OptimizerSettings both;
  both.members = {{"a", 1, settings_of("gss_nlc")}, {"b", 1, settings_of("genetic")}};
  EXPECT_THROW(make_optimizer(Method::ensemble, space, both, nonlinear), InputError);
}

TEST(DirectMethods, KeepToLinearConstraints) {
  // The point of x + y <= 1.2 nearest to (1, 1) is (0.6, 0.6), which is the minimum of (x - 1)^2 +
  // (y - 1)^2. If x - y = 0.2 is required in addition, it is (0.7, 0.5).
  const LinearConstraint sum{.name = "sum", .coefficients = {1, 1}, .upper = 1.2};
  const LinearConstraint gap{.name = "gap", .coefficients = {1, -1}, .lower = 0.2, .upper = 0.2};
  const auto f = [](const auto& x) { return std::pow(x[0] - 1.0, 2) + std::pow(x[1] - 1.0, 2); };
  const DesignSpace below(box({0.3, 0.1}, 0.0, 1.0).variables(), {sum});
  const DesignSpace line(box({0.3, 0.1}, 0.0, 1.0).variables(), {sum, gap});
  for (const auto& [space, x, y] : {std::tuple{below, 0.6, 0.6}, std::tuple{line, 0.7, 0.5}}) {
    NelderMead simplex(space);
    Genetic genetic(space);
    for (Optimizer* method : std::initializer_list<Optimizer*>{&simplex, &genetic}) {
      const Found found = minimize(*method, space, f);
      EXPECT_NEAR(found.x[0], x, 0.02);
      EXPECT_NEAR(found.x[1], y, 0.02);
    }
  }
}

TEST(DirectMethods, RejectOptionsOutOfRange) {
  const DesignSpace space = box({0.5}, 0.0, 1.0);
  EXPECT_THROW(NelderMead(space, {.initial_step = 0.0}), InputError);
  EXPECT_THROW(NelderMead(space, {.step_tolerance = 0.5}), InputError);
  EXPECT_THROW(Genetic(space, {.population = 2}), InputError);
  EXPECT_THROW(Genetic(space, {.generations = 0}), InputError);
  EXPECT_THROW(Genetic(space, {.crossover = 1.5}), InputError);
}

}  // namespace
}  // namespace latsch
