// SPDX-License-Identifier: Apache-2.0
#include "optimization/trust_region/lost_variables.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "optimization/problem/point_vector.h"
#include "optimization/trust_region/residual_trust_region.h"

namespace latsch {
namespace {

using Residuals = std::function<std::vector<double>(const std::vector<double>&)>;

DesignSpace space_of(std::vector<double> initial, double lower, double upper) {
  std::vector<DesignVariable> variables;
  for (const double x : initial) {
    variables.push_back({.name = "x" + std::to_string(variables.size()),
                         .lower = lower,
                         .upper = upper,
                         .initial = x});
  }
  return DesignSpace(variables);
}

Eigen::VectorXd unit(const DesignSpace& space, const std::vector<double>& x) {
  return to_vector(space.to_unit({x}));
}

/// Runs the tests of the search and returns the lost variables it finds, if a move has an effect
/// only through the variables `felt`.
std::vector<int> lost_of(LostVariables& search, const Eigen::VectorXd& u, std::vector<int> felt) {
  for (int tests = 0; search.is_testing(); ++tests) {
    EXPECT_LT(tests, 2 + std::log2(u.size()) + u.size());
    const Eigen::VectorXd moved = search.next() - u;
    bool is_felt = false;
    for (const int i : felt) is_felt = is_felt || moved[i] != 0.0;
    search.observe(is_felt);
  }
  return search.lost();
}

TEST(LostVariables, AreFoundByBisectionInTheOrderOfTheirSlopes) {
  const DesignSpace space = space_of({1, 2, 3, 4, 5, 6, 7}, 0.0, 8.0);
  const FeasibleRegion region(space);
  const Eigen::VectorXd u = unit(space, space.initial().values);
  const Eigen::VectorXd test = Eigen::VectorXd::Constant(7, 0.01);
  const Eigen::VectorXd slopes{{0.1, 5.0, 0.2, 0.0, 7.0, 0.3, 9.0}};
  LostVariables three(space, region, u, slopes, test);
  EXPECT_EQ(lost_of(three, u, {1, 2, 4, 5, 6}), (std::vector{3, 0}));
  LostVariables none(space, region, u, slopes, test);
  EXPECT_TRUE(lost_of(none, u, {0, 1, 2, 3, 4, 5, 6}).empty());
  EXPECT_FALSE(none.has_next());
}

// Slopes of a model of few samples are wrong, so the order of the variables is wrong: bisection
// finds only the first of three lost variables.
TEST(LostVariables, AreFoundOneByOneBehindOneThatIsFelt) {
  const DesignSpace space = space_of({1, 2, 3, 4, 5, 6, 7}, 0.0, 8.0);
  const FeasibleRegion region(space);
  const Eigen::VectorXd u = unit(space, space.initial().values);
  const Eigen::VectorXd test = Eigen::VectorXd::Constant(7, 0.01);
  const Eigen::VectorXd slopes{{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7}};
  LostVariables three(space, region, u, slopes, test);
  EXPECT_EQ(lost_of(three, u, {1, 2, 4, 5}), (std::vector{0, 3, 6}));
  EXPECT_TRUE(three.has_next());
}

TEST(LostVariables, NothingLostIsSeenByTheFirstTest) {
  const DesignSpace space = space_of({1, 2, 3}, 0.0, 8.0);
  const FeasibleRegion region(space);
  LostVariables none(space,
                     region,
                     unit(space, {1, 2, 3}),
                     Eigen::Vector3d{0.1, 0.2, 0.3},
                     Eigen::Vector3d::Constant(0.01));
  none.observe(true);
  EXPECT_FALSE(none.has_next());
}

TEST(LostVariables, AreLookedForTogetherByTheirMagnitudeInsideTheBounds) {
  const DesignSpace space = space_of({1.0, 6.0, -4.0}, -10.0, 10.0);
  const FeasibleRegion region(space);
  const Eigen::VectorXd u = unit(space, {1.0, 6.0, -4.0});
  LostVariables search(
      space, region, u, Eigen::Vector3d{1.0, 0.0, 0.0}, Eigen::Vector3d::Constant(0.01));
  ASSERT_EQ(lost_of(search, u, {0}), (std::vector{1, 2}));
  std::vector<std::vector<double>> places;
  for (; search.has_next(); search.observe(false)) {
    const Eigen::VectorXd place = search.next();
    places.push_back(space.from_unit({place.begin(), place.end()}).values);
  }
  ASSERT_GE(places.size(), 5u);
  const std::vector<std::vector<double>> first{
      {1, 3, -2}, {1, 10, -8}, {1, 1.5, -1}, {1, 10, -10}, {1, 0.75, -0.5}};
  for (std::size_t k = 0; k < first.size(); ++k) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(places[k][i], first[k][i], 1e-12);
  }
  // Eight and sixteen times the value end at the bounds, as four times does, so they are not tried
  // again.
  EXPECT_EQ(places.size(), 8u);
}

TEST(LostVariables, KeepToLinearConstraints) {
  std::vector<DesignVariable> variables(2);
  variables[0] = {.name = "a", .lower = 0.0, .upper = 10.0, .initial = 8.0};
  variables[1] = {.name = "b", .lower = 0.0, .upper = 10.0, .initial = 8.0};
  const DesignSpace space(variables, {{.name = "sum", .coefficients = {1.0, 1.0}, .lower = 12.0}});
  const FeasibleRegion region(space);
  const Eigen::VectorXd u = unit(space, {8.0, 8.0});
  LostVariables search(space, region, u, Eigen::Vector2d{0, 0}, Eigen::Vector2d{0.01, -0.02});
  EXPECT_EQ(lost_of(search, u, {}).size(), 2u);
  for (; search.has_next(); search.observe(false)) EXPECT_TRUE(region.contains(search.next()));
}

// The model is a spectrum over t = 0 ... 10 with a slope and two peaks, 1 + t / 10 + e^-(t - 3)^2 +
// 2 e^-3 (t - 7)^2. At the start both peaks lie beyond the data and are too narrow to have an
// effect.
std::vector<double> peaks(const std::vector<double>& x) {
  std::vector<double> r;
  for (double t = 0.0; t <= 10.0; t += 0.2) {
    const auto peak = [t](double height, double center, double width) {
      return height * std::exp(-width * (t - center) * (t - center));
    };
    const double model = x[0] + x[1] * t + peak(x[2], x[3], x[4]) + peak(x[5], x[6], x[7]);
    r.push_back(model - (1.0 + 0.1 * t + peak(1.0, 3.0, 1.0) + peak(2.0, 7.0, 3.0)));
  }
  return r;
}

struct Found {
  double f = INFINITY;
  int evaluations = 0;
};

Found fit_peaks(int restarts, int outstanding, int most_evaluations) {
  const DesignSpace space = space_of({3, 1, 8, 24, 10, 15, 55, 20}, 0.0, 100.0);
  ResidualTrustRegion method(space, {.restarts = restarts, .outstanding = outstanding});
  Found found;
  while (!method.converged() && found.f > 1e-3 && ++found.evaluations < most_evaluations) {
    const std::vector<DesignPoint> plan = method.propose(2);
    Score score;
    score.residuals = peaks(plan.front().values);
    score.value = 0.0;
    for (const double r : score.residuals) score.value += r * r;
    found.f = std::min(found.f, score.value);
    method.observe(plan.front(), score);
  }
  return found;
}

// Gap and stiffness of a stop that is never touched are lost. The main search leaves them at their
// bounds; the search for them must not depend on that.
TEST(LostVariables, AreLookedForWhereTheSearchEndedOnBounds) {
  const DesignSpace space({{.name = "k", .lower = 50, .upper = 500, .initial = 100},
                           {.name = "gap", .lower = 0, .upper = 0.2, .initial = 0.16},
                           {.name = "ks", .lower = 10, .upper = 5000, .initial = 3000}});
  const auto force = [](const std::vector<double>& x, double d) {
    return x[0] * d + x[2] * std::max(0.0, d - x[1]);
  };
  ResidualTrustRegion method(space);
  double best = INFINITY;
  for (int k = 0; k < 200 && !method.converged(); ++k) {
    const DesignPoint point = method.propose(1).front();
    Score score;
    score.value = 0.0;
    for (int i = 0; i <= 24; ++i) {
      const double d = 0.0025 * i;
      score.residuals.push_back(force(point.values, d) - force({180, 0.03, 600}, d));
      score.value += score.residuals.back() * score.residuals.back();
    }
    best = std::min(best, score.value);
    method.observe(point, score);
  }
  EXPECT_LT(best, 1e-3);  // without the stop the sum of squares is 3e2
}

TEST(LostVariables, PeaksOutsideTheDataAreBroughtBack) {
  const Found without = fit_peaks(0, 1, 1000);
  EXPECT_GT(without.f, 1.0);  // the best fit without the peaks is a straight line
  EXPECT_LT(without.evaluations, 200);
  EXPECT_LT(fit_peaks(100, 1, 1000).f, 1e-3);
  EXPECT_LT(fit_peaks(100, 8, 2000).f, 1e-3);
}

}  // namespace
}  // namespace latsch
