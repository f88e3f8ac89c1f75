// SPDX-License-Identifier: Apache-2.0
#include "optimization/direct_search/gss.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "optimization/design/full_factorial.h"
#include "optimization/region/generating_set.h"

namespace latsch {
namespace {

using Function = std::function<double(const std::vector<double>&)>;

DesignSpace box(const std::vector<double>& initial, double lower, double upper) {
  std::vector<DesignVariable> variables;
  for (std::size_t i = 0; i < initial.size(); ++i) {
    variables.push_back(
        {.name = fmt::format("x{}", i), .lower = lower, .upper = upper, .initial = initial[i]});
  }
  return DesignSpace(variables);
}

struct Found {
  std::vector<double> x;
  double f = INFINITY;
  int evaluations = 0;
};

/// Runs the search until it converges. A value that is not finite counts as a failed trial.
Found minimize(const DesignSpace& space, const Function& function, const GssOptions& options = {}) {
  Gss gss(space, options);
  Found found;
  while (!gss.converged() && found.evaluations < 5000) {
    const DesignPoint point = gss.propose(1).front();
    EXPECT_TRUE(space.contains(point));
    const double f = function(point.values);
    ++found.evaluations;
    if (f < found.f) found = {point.values, f, found.evaluations};
    gss.observe(point, std::isfinite(f) ? Result<Score>(Score{f}) : Failure{"failed"});
  }
  EXPECT_TRUE(gss.converged());
  return found;
}

/// The function of Fig. 1 of Hempel and Oertel, KGK 04/2016. Along y it has a local minimum at
/// (-0.15, 0.79) and the global one at (-0.15, -1.15).
double two_basins(const std::vector<double>& x) {
  const double a = 0.79, b = -1.15, s = 0.0;  // df/dy = (y - a) (y - b) (y - s)
  const double y = x[1];
  return (x[0] + 0.15) * (x[0] + 0.15) + y * y * y * y / 4 - (a + b + s) * y * y * y / 3 +
         (a * b + a * s + b * s) * y * y / 2 - a * b * s * y;
}

/// A target like those of the tire studies: the sum of mean relative errors, without squares, of
/// eight frequencies  sqrt(c + sum w_k E_k)  and of three forces  d + sum v_k E_k^0.8.  It is zero
/// if all stiffnesses E_k are 1.
double twin_target(const std::vector<double>& E) {
  constexpr std::array<std::array<double, 3>, 8> w{{{.5, .1, .1},
                                                    {.3, .1, .3},
                                                    {.2, .1, .5},
                                                    {.4, .2, .1},
                                                    {.1, .1, .6},
                                                    {.3, .3, .2},
                                                    {.2, .2, .2},
                                                    {.1, .3, .4}}};
  constexpr std::array<std::array<double, 3>, 3> v{{{.35, .2, .05}, {.4, .2, .05}, {.38, .25, .1}}};
  const auto error = [&](const std::array<double, 3>& share, double exponent, double root) {
    double simulated = 1.0;
    for (int k = 0; k < 3; ++k) simulated += share[k] * (std::pow(E[k], exponent) - 1.0);
    return std::abs(1.0 - std::pow(simulated, root));
  };
  double frequencies = 0.0, forces = 0.0;
  for (const auto& share : w) frequencies += error(share, 1.0, 0.5) / w.size();
  for (const auto& share : v) forces += error(share, 0.8, 1.0) / v.size();
  return 0.5 * (frequencies + forces);
}

DesignSpace twin_space(const std::array<double, 3>& initial) {
  std::vector<DesignVariable> variables;
  for (int k = 0; k < 3; ++k) {
    variables.push_back({.name = fmt::format("E{}", k),
                         .lower = 0.2,
                         .upper = 4.0,
                         .initial = initial[k],
                         .scale = Scale::logarithmic});
  }
  return DesignSpace(variables);
}

double rosenbrock(const std::vector<double>& x) {
  return 100.0 * std::pow(x[1] - x[0] * x[0], 2) + std::pow(1.0 - x[0], 2);
}

TEST(GeneratingSet, HasADirectionDownhillForEveryGradient) {
  // The cosine between any vector and the nearest direction to a vertex of a regular simplex in n
  // dimensions is at least 1/n.
  for (const int turn : {0, 1, 2, 17, 400}) {
    const auto directions = generating_set(std::vector<Bound>(3, Bound::none), turn);
    ASSERT_EQ(directions.size(), 4u);
    for (int k = 0; k < 500; ++k) {
      const Eigen::Vector3d g =
          Eigen::Vector3d(std::sin(1.0 * k), std::sin(2.3 * k + 1), std::cos(3.7 * k)).normalized();
      double best = -1.0;
      for (const auto& d : directions) best = std::max(best, d.dot(g));
      EXPECT_GE(best, 1.0 / 3.0 - 1e-12);
    }
  }
}

TEST(GeneratingSet, ConformsToBounds) {
  const auto directions = generating_set({Bound::upper, Bound::none, Bound::lower}, 5);
  ASSERT_EQ(directions.size(), 4u);
  EXPECT_EQ(directions[0], Eigen::Vector3d(-1, 0, 0));
  EXPECT_EQ(directions[1], Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(directions[2], -directions[3]);
  EXPECT_DOUBLE_EQ(std::abs(directions[2][1]), 1.0);
}

TEST(Gss, FindsTheMinimumOfAQuadratic) {
  const Found found = minimize(box({3.0, -2.0, 1.0}, -5.0, 5.0), [](const auto& x) {
    const double a = x[0] - 1.0, b = x[1] - 0.5, c = x[2] + 2.0;
    return a * a + 10.0 * b * b + 100.0 * c * c + 3.0 * a * b;
  });
  // The quadratic model is exact for a quadratic target. The step tolerance of 1e-3 of the range of
  // 10 limits the accuracy to 0.01.
  EXPECT_NEAR(found.x[0], 1.0, 0.01);
  EXPECT_NEAR(found.x[1], 0.5, 0.01);
  EXPECT_NEAR(found.x[2], -2.0, 0.01);
  EXPECT_LT(found.evaluations, 120);
}

TEST(Gss, FollowsRosenbrocksValley) {
  GssOptions options;
  options.step_tolerance = 1e-4;
  const Found found = minimize(box({-1.2, 1.0}, -2.0, 2.0), rosenbrock, options);
  EXPECT_LT(found.f, 1e-4);  // the value at the start is 24.2
  EXPECT_LT(found.evaluations, 300);
}

TEST(Gss, EndsInTheBasinItStartsIn) {
  const Found local = minimize(box({1.0, 1.2}, -2.0, 2.0), two_basins);
  EXPECT_NEAR(local.x[0], -0.15, 0.01);
  EXPECT_NEAR(local.x[1], 0.79, 0.01);
  const Found global = minimize(box({1.0, -0.6}, -2.0, 2.0), two_basins);
  EXPECT_NEAR(global.x[1], -1.15, 0.01);
  EXPECT_LT(global.f, local.f);
}

TEST(Gss, AFullFactorialDesignLeadsToTheGlobalBasin) {
  const DesignSpace space = box({1.0, 1.2}, -2.0, 2.0);
  Gss gss(space);
  for (const DesignPoint& point : full_factorial(space, {9, 9}).points) {
    gss.observe(point, Score{two_basins(point.values)});
  }
  DesignPoint best;
  double f = INFINITY;
  while (!gss.converged()) {
    const DesignPoint point = gss.propose(1).front();
    const double value = two_basins(point.values);
    if (value < f) f = value, best = point;
    gss.observe(point, Score{value});
  }
  EXPECT_NEAR(best.values[1], -1.15, 0.01);
}

TEST(Gss, DoesNotStopAtKinks) {
  // At points (t, t, t) the target rises in all six coordinate directions, although the minimum is
  // at the origin.
  const Found found = minimize(box({3.0, 2.0, 1.5}, -4.0, 5.0), [](const auto& x) {
    return 10.0 * (std::abs(x[0] - x[1]) + std::abs(x[1] - x[2])) + std::abs(x[0] + x[1] + x[2]);
  });
  for (const double x : found.x) EXPECT_NEAR(x, 0.0, 0.05);  // 0.5 % of the range of each variable
}

TEST(Gss, RecoversModuliOfATwinWithinOnePercent) {
  int most = 0;
  for (const std::array<double, 3>& initial : {std::array{2.0, 0.5, 2.0},
                                               {0.5, 2.0, 0.5},
                                               {2.0, 2.0, 0.5},
                                               {0.5, 0.5, 2.0},
                                               {2.0, 2.0, 2.0},
                                               {0.5, 0.5, 0.5},
                                               {1.7, 0.4, 0.6}}) {
    Gss gss(twin_space(initial));
    int evaluations = 0, last_off = 0;
    double best = INFINITY;
    while (!gss.converged()) {
      const DesignPoint point = gss.propose(1).front();
      const double f = twin_target(point.values);
      gss.observe(point, Score{f});
      ++evaluations;
      if (f >= best) continue;
      best = f;
      for (const double E : point.values) {
        if (std::abs(E - 1.0) > 0.01) last_off = evaluations;
      }
    }
    EXPECT_LT(best, 0.001);
    EXPECT_LT(last_off, 100);
    EXPECT_LT(evaluations, 150);
    most = std::max(most, last_off);
  }
  RecordProperty("evaluations_to_one_percent", most);
}

TEST(Gss, FindsAMinimumAtABoundAndInACorner) {
  const auto pulled = [](const std::vector<double>& x) {
    return std::pow(x[0] - 2.0, 2) + std::pow(x[1] - 0.3, 2) + 0.5 * x[0] * x[1];
  };
  const Found face = minimize(box({0.2, 0.8}, 0.0, 1.0), pulled);
  EXPECT_EQ(face.x[0], 1.0);  // the solution is on the bound with exactly its bits
  EXPECT_NEAR(face.x[1], 0.05, 2e-3);
  const Found corner = minimize(box({0.5, 0.5, 0.5}, 0.0, 1.0),
                                [](const auto& x) { return x[0] - 2.0 * x[1] + x[2]; });
  EXPECT_EQ(corner.x, (std::vector<double>{0.0, 1.0, 0.0}));
}

TEST(Gss, GoesAroundPointsThatFail) {
  // The model fails at points with x0 > 0.62 and in a ball on the path to the minimum.
  const Found found = minimize(box({0.1, 0.1, 0.9}, 0.0, 1.0), [](const auto& x) {
    const bool in_ball = std::hypot(x[0] - 0.35, x[1] - 0.35, x[2] - 0.6) < 0.1;
    if (x[0] > 0.62 || in_ball) return std::nan("");
    return std::abs(x[0] - 0.6) + std::abs(x[1] - 0.7) + std::abs(x[2] - 0.4);
  });
  EXPECT_NEAR(found.x[0], 0.6, 5e-3);
  EXPECT_NEAR(found.x[1], 0.7, 5e-3);
  EXPECT_NEAR(found.x[2], 0.4, 5e-3);
}

TEST(Gss, EndsWhereEverythingFails) {
  const Found found = minimize(box({0.5, 0.5}, 0.0, 1.0), [](const auto&) { return std::nan(""); });
  EXPECT_TRUE(std::isinf(found.f));
}

TEST(Gss, WhatItWantsFirstDoesNotDependOnHowManyPointsAreAskedFor) {
  Gss gss(twin_space({2.0, 0.5, 2.0}));
  while (!gss.converged()) {
    const DesignPoint first = gss.propose(1).front();
    const std::vector<DesignPoint> plan = gss.propose(9);
    EXPECT_EQ(plan.front(), first);
    for (std::size_t i = 0; i < plan.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) EXPECT_NE(plan[i], plan[j]);
    }
    gss.observe(first, Score{twin_target(first.values)});
  }
}

TEST(Gss, SpeculationComesTrueWhereTrialsBringNothing) {
  Gss gss(box({0.4, 0.6}, 0.0, 1.0));
  gss.observe(gss.propose(1).front(), Score{1.0});
  const std::vector<DesignPoint> plan = gss.propose(3);
  for (const DesignPoint& point : plan) {
    EXPECT_EQ(gss.propose(1).front(), point);
    gss.observe(point, Failure{"no"});
  }
}

TEST(Gss, RejectsOptionsOutOfRange) {
  const DesignSpace space = box({0.5}, 0.0, 1.0);
  EXPECT_THROW(Gss(space, {.initial_step = 0.0}), InputError);
  EXPECT_THROW(Gss(space, {.step_tolerance = 0.5}), InputError);
  EXPECT_THROW(Gss(space, {.contraction = 1.0}), InputError);
  EXPECT_THROW(Gss(space, {.sufficient_decrease = -1.0}), InputError);
  EXPECT_NO_THROW(Gss{space});
}

}  // namespace
}  // namespace latsch
