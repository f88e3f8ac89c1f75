// SPDX-License-Identifier: Apache-2.0
#include "optimization/trust_region/residual_trust_region.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>
#include <string>

#include "base/random.h"
#include "optimization/design/full_factorial.h"

namespace latsch {
namespace {

using Options = ResidualTrustRegionOptions;
using Residuals = std::function<std::vector<double>(const std::vector<double>&)>;

DesignSpace box(const std::vector<double>& initial, double lower, double upper, Scale scale) {
  std::vector<DesignVariable> variables;
  for (const double x : initial) {
    variables.push_back({.name = fmt::format("x{}", variables.size()),
                         .lower = lower,
                         .upper = upper,
                         .initial = x,
                         .scale = scale});
  }
  return DesignSpace(variables);
}

Score score(const std::vector<double>& residuals) {
  double sum = 0.0;
  for (const double r : residuals) sum += r * r;
  return {sum, residuals};
}

struct Found {
  std::vector<double> x;
  double f = INFINITY;
  int evaluations = 0;
};

/// Runs until converged. Residuals that are not finite are a failed trial.
Found minimize(ResidualTrustRegion& method, const DesignSpace& space, const Residuals& residuals) {
  Found found;
  while (!method.converged() && found.evaluations < 2000) {
    const DesignPoint point = method.propose(1).front();
    EXPECT_TRUE(space.contains(point));
    const Score now = score(residuals(point.values));
    ++found.evaluations;
    if (now.value < found.f) found = {point.values, now.value, found.evaluations};
    method.observe(point, std::isfinite(now.value) ? Result<Score>(now) : Failure{"failed"});
  }
  EXPECT_TRUE(method.converged());
  return found;
}

Found minimize(const DesignSpace& space, const Residuals& residuals, const Options& options = {}) {
  ResidualTrustRegion method(space, options);
  return minimize(method, space, residuals);
}

/// Returns frequencies  sqrt(1 + sum w_ik (E_k - 1))  and forces  1 + sum v_jk (E_k^0.8 - 1)  of a
/// tire with five stiffnesses E_k, relative to those at E = 1.
std::vector<double> tire(const std::vector<double>& E) {
  std::vector<double> r;
  for (int i = 0; i < 14; ++i) {
    RandomStream weight(3, i);
    double simulated = 1.0, sum = 1e-3;
    std::vector<double> w;
    for (std::size_t k = 0; k < E.size(); ++k) sum += w.emplace_back(std::pow(weight.uniform(), 2));
    for (std::size_t k = 0; k < E.size(); ++k) {
      simulated += 0.9 * w[k] / sum * (std::pow(E[k], i < 9 ? 1.0 : 0.8) - 1.0);
    }
    r.push_back(1.0 - std::pow(simulated, i < 9 ? 0.5 : 1.0));
  }
  return r;
}

std::vector<double> rosenbrock(const std::vector<double>& x) {
  return {10.0 * (x[1] - x[0] * x[0]), 1.0 - x[0]};
}

TEST(ResidualTrustRegion, IdentifiesFiveStiffnessesWithinAPercentInSixtyEvaluations) {
  int most = 0;
  for (int start = 0; start < 20; ++start) {
    RandomStream random(11, start);
    std::vector<double> initial(5);
    for (double& x : initial) x = 0.2 * std::pow(20.0, random.uniform());
    const DesignSpace space = box(initial, 0.2, 4.0, Scale::logarithmic);
    const Found found = minimize(space, tire);
    for (const double E : found.x) EXPECT_NEAR(E, 1.0, 0.01);
    most = std::max(most, found.evaluations);
  }
  EXPECT_LE(most, 60);
  RecordProperty("most_evaluations", most);
}

TEST(ResidualTrustRegion, FollowsRosenbrocksValley) {
  const Found found = minimize(box({-1.2, 1.0}, -2.0, 2.0, Scale::linear), rosenbrock);
  EXPECT_LT(found.f, 1e-6);          // the value at the start is 24.2
  EXPECT_LT(found.evaluations, 30);  // six points determine quadratic residuals
}

TEST(ResidualTrustRegion, FindsAMinimumAtABound) {
  const Found found = minimize(box({0.3, 0.6}, 0.0, 1.0, Scale::linear), [](const auto& x) {
    return std::vector{x[0] - 2.0, x[1] - 0.3, 0.5 * x[0] * x[1]};
  });
  EXPECT_EQ(found.x[0], 1.0);                 // the solution is on the bound with exactly its bits
  EXPECT_NEAR(found.x[1], 0.3 / 1.25, 1e-3);  // (y - 0.3)^2 + y^2 / 4
}

TEST(ResidualTrustRegion, IsLevenbergMarquardtWhereItGetsJacobians) {
  const DesignSpace space = box({-1.2, 1.0}, -2.0, 2.0, Scale::linear);
  ResidualTrustRegion method(space);
  double best = INFINITY;
  int evaluations = 0;
  for (; !method.converged() && best > 1e-8; ++evaluations) {
    const DesignPoint point = method.propose(1).front();
    const double x = point.values[0];
    Score now = score(rosenbrock(point.values));
    now.jacobian = {-20.0 * x, 10.0, -1.0, 0.0};
    best = std::min(best, now.value);
    method.observe(point, now);
  }
  EXPECT_LT(best, 1e-8);
  EXPECT_LE(evaluations, 15);
}

TEST(ResidualTrustRegion, StartsFromADesignWithoutProbing) {
  const DesignSpace space = box({3.0, 0.3}, 0.2, 4.0, Scale::logarithmic);
  const Residuals residuals = [](const auto& x) {
    return std::vector{std::log(x[0]), x[0] * x[1] - 1.0, 0.2 * (x[1] - 1.0)};
  };
  ResidualTrustRegion method(space);
  for (const DesignPoint& point : full_factorial(space, {4, 4}).points) {
    method.observe(point, score(residuals(point.values)));
  }
  const Found found = minimize(method, space, residuals);
  EXPECT_NEAR(found.x[0], 1.0, 1e-3);
  EXPECT_LT(found.evaluations, minimize(space, residuals).evaluations);
}

TEST(ResidualTrustRegion, GoesAroundAFailedRegion) {
  // The model fails in a half space beside the minimum and in a ball on the path to it.
  const DesignSpace space = box({0.1, 0.1, 0.9}, 0.0, 1.0, Scale::linear);
  const Found found = minimize(space, [](const std::vector<double>& x) {
    const bool in_ball = std::hypot(x[0] - 0.35, x[1] - 0.35, x[2] - 0.6) < 0.1;
    const double none = x[0] > 0.62 || in_ball ? std::nan("") : 0.0;
    return std::vector{std::exp(x[0]) - std::exp(0.6) + none, x[1] * x[1] - 0.49, x[2] - 0.4};
  });
  EXPECT_NEAR(found.x[0], 0.6, 2e-3);
  EXPECT_NEAR(found.x[1], 0.7, 2e-3);
  EXPECT_NEAR(found.x[2], 0.4, 2e-3);
}

TEST(ResidualTrustRegion, EndsAtTheEdgeOfAFailedRegionNotBeforeIt) {
  // All points beyond x + y / 2 = 0.9 fail. The minimum of |x - (0.8, 0.7)|^2 in the remaining
  // region is the foot of the perpendicular, (0.8, 0.7) - 0.25 / 1.25 (1, 0.5).
  const DesignSpace space = box({0.1, 0.9}, 0.0, 1.0, Scale::linear);
  ResidualTrustRegion method(space);
  const Found found = minimize(method, space, [](const std::vector<double>& x) {
    const double none = x[0] + 0.5 * x[1] > 0.9 ? std::nan("") : 0.0;
    return std::vector{x[0] - 0.8 + none, x[1] - 0.7};
  });
  EXPECT_NEAR(found.x[0], 0.6, 5e-3);
  EXPECT_NEAR(found.x[1], 0.6, 5e-3);
  EXPECT_LT(found.f, 0.05 * (1.0 + 1e-2));
  EXPECT_NE(method.ending().find("edge of failed"), std::string::npos) << method.ending();
}

TEST(ResidualTrustRegion, VerifiesBeforeItEndsOnRoughGround) {
  // One of two directions has a hundredth of the other's effect, and residuals have a ripple of
  // 1e-3: differences over short moves contain only the ripple.
  const DesignSpace space = box({0.2, 0.8}, 0.0, 1.0, Scale::linear);
  ResidualTrustRegion method(space);
  double best = INFINITY;  // best value of the residuals without ripple
  const Found found = minimize(method, space, [&](const std::vector<double>& x) {
    std::vector<double> r;
    double exact = 0.0;
    for (int i = 0; i < 20; ++i) {
      const double t = 0.05 * i, s = x[0] + x[1] - 1.1, d = x[0] - x[1] + 0.1;
      const double smooth = s * (1.0 + t) + 0.03 * std::sin(6.0 * t) * d + 0.2 * s * s * t;
      exact += smooth * smooth;
      r.push_back(smooth + 1e-3 * std::sin(300.0 * x[0] * (1.0 + t) + 200.0 * x[1] + 5.0 * i));
    }
    best = std::min(best, exact);
    return r;
  });
  EXPECT_LT(best, 20 * 1e-6);            // the error is below the ripple
  EXPECT_LT(found.evaluations, 50 * 3);  // 50 (n + 1)
}

// The exponent and the factor of a power law compensate each other, and residuals have a ripple of
// 3e-3. The slopes of the search contain only the ripple, and so do recomputed slopes over moves
// that change the residuals by their own size.
TEST(ResidualTrustRegion, GoesFartherBeforeItEndsInTheNoise) {
  const DesignSpace space = box({0.2, 0.8, 0.9}, 0.0, 1.0, Scale::linear);
  const auto curve = [](const std::vector<double>& x, double t) {
    return x[0] * t + std::pow(10.0, 3.0 * x[1] - 2.0) * std::pow(t, 1.0 + 4.0 * x[2]);
  };
  double best = INFINITY;  // best value of the residuals without ripple
  std::set<std::string> asked;
  const Found found = minimize(space, [&](const std::vector<double>& x) {
    std::vector<double> r;
    double exact = 0.0;
    for (int i = 0; i < 20; ++i) {
      const double t = 0.05 * (i + 1), smooth = curve(x, t) - curve({0.5, 0.5, 0.4}, t);
      double phase = 5.0 * i;
      for (int k = 0; k < 3; ++k) phase += (200 + 70 * k + 11 * ((i * (k + 3)) % 7)) * x[k];
      exact += smooth * smooth;
      r.push_back(smooth + 3e-3 * std::sin(phase));
    }
    best = std::min(best, exact);
    asked.insert(DesignPoint{x}.bits());
    return r;
  });
  // A fifth of the ripple's value; it is 7.6 at the start.
  EXPECT_LT(best, 0.2 * 20 * 0.5 * 9e-6);
  EXPECT_GE(std::ssize(asked), found.evaluations);  // no point was evaluated twice
}

/// Sixty residuals of six stiffnesses, which are all 1 in the data. The data have errors of 0.02,
/// and the residuals a ripple of 0.007 with 20 to 100 waves over every range, like that of a
/// rolling finite-element mesh.
std::vector<double> rippled(const std::vector<double>& E, int draw, bool has_ripple) {
  std::vector<double> r;
  for (int i = 0; i < 60; ++i) {
    RandomStream random(100 + draw, i);
    double simulated = 1.0, sum = 1e-3, phase = 2.0 * M_PI * random.uniform();
    std::vector<double> w;
    for (std::size_t k = 0; k < E.size(); ++k) sum += w.emplace_back(std::pow(random.uniform(), 3));
    for (std::size_t k = 0; k < E.size(); ++k) {
      simulated += 0.9 * w[k] / sum * (std::pow(E[k], i % 2 ? 1.0 : 0.7) - 1.0);
      const double waves = 20.0 * std::pow(5.0, random.uniform());
      phase += 2.0 * M_PI * (random.uniform() < 0.5 ? -1.0 : 1.0) * waves * std::log(E[k] / 0.2) /
               std::log(4.0 / 0.2);
    }
    r.push_back(1.0 - std::sqrt(simulated) + 0.02 * random.normal());
    if (has_ripple) r.back() += 0.007 * std::sin(phase);
  }
  return r;
}

// The limit on evaluations is 20 (n + 1). The search would need 24 (n + 1) if it verified every
// restart that improved the value by chance and probed over lengths far below those of the ripple.
TEST(ResidualTrustRegion, EndsOnARippledProblemInWhatNoiseAllows) {
  const DesignSpace space = box({3.0, 0.4, 2.0, 0.5, 1.5, 0.6}, 0.2, 4.0, Scale::logarithmic);
  int evaluations = 0;
  for (int draw = 0; draw < 8; ++draw) {
    ResidualTrustRegion method(space);
    DesignPoint best;
    double least = INFINITY;
    int count = 0;
    for (; !method.converged() && count < 1000; ++count) {
      const DesignPoint point = method.propose(1).front();
      const Score now = score(rippled(point.values, draw, true));
      if (now.value < least) {
        least = now.value;
        best = point;
      }
      method.observe(point, now);
    }
    EXPECT_NE(method.ending(), "");
    evaluations += count;
    const double exact = score(rippled(best.values, draw, false)).value;
    const Found found = minimize(space, [&](const auto& E) { return rippled(E, draw, false); });
    // The difference allowed is one standard deviation in every stiffness.
    EXPECT_LT(exact, found.f + 6.0 * 0.02 * 0.02);
  }
  EXPECT_LT(evaluations, 8 * 20 * 7);  // 20 (n + 1) on average
}

// In a curved valley with 1 % of noise on every residual, a step that gains by chance leads to a
// smaller box, and a good step in this box to a still smaller one. Without widening the box, only
// 24 of the 60 random draws came so close to the minimum.
TEST(ResidualTrustRegion, SearchesOnWhereItChasedNoiseIntoASmallBox) {
  constexpr double kLeast = 9.76723;  // at (0.143, -0.009)
  int solved = 0;
  for (int draw = 0; draw < 60; ++draw) {
    const DesignSpace space = box({-2.0, 4.0}, -100.0, 100.0, Scale::linear);
    ResidualTrustRegion method(space, {.initial_radius = 5e-4, .step_tolerance = 1e-8});
    double first = INFINITY, least = INFINITY;  // without noise
    const auto is_solved = [&] { return least - kLeast < 1e-2 * (first - kLeast); };
    for (int k = 0; k < 40 && !method.converged() && !is_solved(); ++k) {
      const DesignPoint point = method.propose(1).front();
      const double x = point.values[0], y = point.values[1];
      std::vector<double> r{10.0 * (y - x * x), 1.0 - x, 3.0 + y};
      least = std::min(least, score(r).value);
      if (k == 0) first = least;
      RandomStream random(draw, k);
      for (double& value : r) value *= 1.0 + 0.01 * random.normal();
      method.observe(point, score(r));
    }
    solved += is_solved();
  }
  EXPECT_GE(solved, 45);
}

// A bound is a wall and no scale: a decay whose bounds are a thousand times farther away is fitted
// by the same points.
TEST(ResidualTrustRegion, TakesTheSameStepsHoweverFarTheBoundsAre) {
  const auto decay = [](const std::vector<double>& x) {
    std::vector<double> r;
    for (int i = 0; i < 30; ++i) {
      const double t = 0.1 * i;
      r.push_back(x[0] * std::exp(-x[1] * t) - 3.0 * std::exp(-0.9 * t));
    }
    return r;
  };
  const auto within = [&](double reach) {
    return minimize(box({6.0, 2.2}, 0.0, reach, Scale::linear), decay);
  };
  const Found near = within(1e3), far = within(1e6);
  EXPECT_EQ(near.evaluations, far.evaluations);
  EXPECT_NEAR(far.x[0], 3.0, 1e-3);
  EXPECT_NEAR(far.x[1], 0.9, 1e-3);
}

// There are two minima: one at a bound, near the start, and one inside. A search that ended at a
// bound is continued from the middle of that range before its result is accepted.
TEST(ResidualTrustRegion, LeavesBoundsOnce) {
  const DesignSpace space = box({0.9, 0.9}, 0.0, 1.0, Scale::linear);
  const Found found = minimize(space, [](const std::vector<double>& x) {
    return std::vector{(x[0] - 0.4) * (1.15 - x[0]), 10.0 * (x[1] - 0.3)};
  });
  EXPECT_NEAR(found.x[0], 0.4, 1e-3);
  EXPECT_NEAR(found.x[1], 0.3, 1e-3);
}

/// A function of two variables. In the first one it has minima near 0.5 (sum of squares 0.6) and at
/// 0.46 (sum of squares 0); at the end of the range the sum of squares is 1e6.
std::vector<double> two_wells(const std::vector<double>& x) {
  return {4e3 * (x[0] - 0.46) * (x[0] - 0.5), 20.0 * (x[0] - 0.46), x[1] - 0.3};
}

// However large the value at the start is, a local minimum does not count as explained.
TEST(ResidualTrustRegion, LooksFurtherFromALocalMinimumWhereverItStarted) {
  for (const double start : {0.52, 0.6, 0.75}) {
    int found = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      const DesignSpace space = box({start, 0.6}, 0.0, 1.0, Scale::linear);
      found += minimize(space, two_wells, {.seed = seed}).f < 1e-3;
    }
    EXPECT_GE(found, 2) << start;
  }
}

TEST(ResidualTrustRegion, SaysWhyItEnded) {
  const DesignSpace space = box({0.3, 0.6}, 0.0, 1.0, Scale::linear);
  ResidualTrustRegion smooth(space);
  EXPECT_EQ(smooth.ending(), "");
  minimize(smooth, space, [](const auto& x) {
    return std::vector{std::exp(x[0]) - 1.5, x[1] - 0.3, 0.5 * x[0] * x[1]};
  });
  EXPECT_NE(smooth.ending().find("at a minimum"), std::string::npos) << smooth.ending();
  ResidualTrustRegion failing(space);
  minimize(failing, space, [](const auto&) { return std::vector{std::nan("")}; });
  EXPECT_NE(failing.ending().find("every trial failed"), std::string::npos) << failing.ending();
}

TEST(ResidualTrustRegion, EndsWhereEverythingFailsWithoutAskingTwice) {
  const DesignSpace space = box({0.5, 0.5}, 0.0, 1.0, Scale::linear);
  ResidualTrustRegion method(space);
  std::set<std::string> asked;
  int count = 0;
  for (; !method.converged() && count < 2000; ++count) {
    const DesignPoint point = method.propose(1).front();
    asked.insert(point.bits());
    method.observe(point, Failure{"failed"});
  }
  EXPECT_TRUE(method.converged());
  EXPECT_EQ(static_cast<int>(asked.size()), count);
}

TEST(ResidualTrustRegion, ForeignPointsOutsideOfTheBoundsAreNotTakenForPointsOnAFace) {
  const DesignSpace space = box({0.3, 0.6}, 0.0, 1.0, Scale::linear);
  const Residuals residuals = [](const auto& x) { return std::vector{x[0] - 2.0, x[1] - 0.3}; };
  ResidualTrustRegion method(space);
  method.observe({{2.0, 0.3}}, score({0.0, 0.0}));
  const Found found = minimize(method, space, residuals);
  EXPECT_EQ(found.x[0], 1.0);
  EXPECT_NEAR(found.f, 1.0, 1e-5);
}

TEST(ResidualTrustRegion, ForeignPointsWithoutAPlaceAreLeftAlone) {
  const DesignSpace space = box({3.0, 0.4}, 0.2, 4.0, Scale::logarithmic);
  const Residuals residuals = [](const auto& x) {
    return std::vector{std::log(x[0]), x[0] * x[1] - 1.0};
  };
  ResidualTrustRegion method(space);
  method.observe({{std::nan(""), 1.0}}, score({0.0, 0.0}));
  method.observe({{-1.0, 1.0}}, score({0.1, 0.1}));
  method.observe({{0.0, 1.0}}, Failure{"failed"});
  const Found found = minimize(method, space, residuals);
  EXPECT_NEAR(found.x[0], 1.0, 1e-3);
  EXPECT_NEAR(found.x[1], 1.0, 1e-3);
  EXPECT_THROW(method.observe({{1.0}}, score({0.0, 0.0})), InputError);
}

TEST(ResidualTrustRegion, ComesCloseUnderNoise) {
  const DesignSpace space = box({3.0, 0.4, 2.0, 0.5, 1.5}, 0.2, 4.0, Scale::logarithmic);
  long number = 0;
  ResidualTrustRegion method(space, {.restarts = 3});
  double best = INFINITY;  // without noise
  for (; !method.converged() && number < 300; ++number) {
    const DesignPoint point = method.propose(1).front();
    std::vector<double> r = tire(point.values);
    best = std::min(best, score(r).value);
    RandomStream random(5, number);
    for (double& x : r) x += 0.002 * random.normal();
    method.observe(point, score(r));
  }
  EXPECT_LT(best, 14 * 0.002 * 0.002);  // the error is below the noise
}

// A hundred values have noise of 1, and a ripple adds local minima to the target. Restarts continue
// until the sum of squares is at the level of the noise, and no further.
TEST(ResidualTrustRegion, RestartsUntilNothingIsLeftButTheNoiseThatIsStated) {
  const DesignSpace space = box({0.9, 0.1}, 0.0, 1.0, Scale::linear);
  constexpr int m = 100;
  const double noise_alone = m + 2.0 * std::sqrt(2.0 * m);
  int stuck = 0;
  for (int draw = 1; draw <= 5; ++draw) {
    const Residuals residuals = [draw](const std::vector<double>& x) {
      std::vector<double> r;
      for (int i = 0; i < m; ++i) {
        RandomStream random(draw, i);
        const double t = 0.01 * i, far = x[0] - 0.4;
        const double valley = 30.0 * far * t + 20.0 * (x[1] - 0.6) + 9.0 * std::sin(25.0 * far);
        r.push_back(valley + random.normal());
      }
      return r;
    };
    const Found stops = minimize(space, residuals, {.restarts = 20, .noise_alone = noise_alone});
    const Found goes_on = minimize(space, residuals, {.restarts = 20});
    EXPECT_LE(stops.f, noise_alone) << draw;
    EXPECT_LT(stops.evaluations, 0.7 * goes_on.evaluations) << draw;
    stuck += minimize(space, residuals, {.restarts = 0}).f > noise_alone;
  }
  EXPECT_GT(stuck, 0);  // some searches ended in a local minimum of the ripple
}

// The walls of a narrow curved valley rise 150 to 600 times as steeply as its floor. A thousandth
// of the value at a start on the wall is therefore thousands of times the noise. Without stated
// noise three of the 36 searches ended at such a value, up to 2.6 times that of the noise, with all
// restarts left.
TEST(ResidualTrustRegion, DoesNotTakeAFarStartForAGoodEndWhereNoiseIsStated) {
  constexpr int m = 100;
  const double noise_alone = m + 2.0 * std::sqrt(2.0 * m);
  for (const double floor : {5.0, 20.0}) {
    for (const double bend : {0.3, 1.0, 3.0}) {
      for (int draw = 0; draw < 6; ++draw) {
        RandomStream start(77, draw);
        const double x0 = 0.1 + 0.8 * start.uniform(), x1 = 0.1 + 0.8 * start.uniform();
        const DesignSpace space({{.name = "x0", .lower = 0.0, .upper = 1.0, .initial = x0},
                                 {.name = "x1", .lower = -1.0, .upper = 2.0, .initial = x1}});
        const Residuals residuals = [&](const std::vector<double>& x) {
          const double far = x[0] - 0.45;
          const double off = x[1] - 0.55 - bend * (0.25 * std::sin(4.0 * far) + 0.3 * far * far);
          std::vector<double> r;
          for (int i = 0; i < m; ++i) {
            RandomStream random(1000 + draw, i);
            const double across = 3000.0 * random.normal(), along = floor * random.normal();
            r.push_back(across * (off + 0.3 * off * off) + along * std::expm1(far) +
                        random.normal());
          }
          return r;
        };
        const Found found = minimize(space, residuals, {.noise_alone = noise_alone});
        // The value at the true parameters.
        ASSERT_LE(score(residuals({0.45, 0.55})).value, noise_alone) << draw;
        EXPECT_LE(found.f, noise_alone) << floor << " " << bend << " " << draw;
      }
    }
  }
}

TEST(ResidualTrustRegion, SaysThatNoiseIsWhatIsLeftOnlyWhereNoiseIsStated) {
  const DesignSpace space = box({0.5, 0.25}, 0.0, 1.0, Scale::linear);
  const Residuals exact = [](const auto& x) { return std::vector{x[0] - 0.5, x[1] - 0.25}; };
  ResidualTrustRegion unknown(space), known(space, {.noise_alone = 1.0});
  EXPECT_EQ(minimize(unknown, space, exact).f, 0.0);
  EXPECT_EQ(unknown.ending().find("stated noise"), std::string::npos) << unknown.ending();
  minimize(known, space, exact);
  EXPECT_NE(known.ending().find("stated noise"), std::string::npos) << known.ending();
}

// If x0 x1 > 2, a mode has no partner and counts as an error of 1. This is a jump beside the path
// from (0.4, 3) to the minimum at (0.8, 1.6), and no smooth model holds on both sides of it.
TEST(ResidualTrustRegion, ALeapThatIsToldIsGoneAround) {
  const auto scored = [](const std::vector<double>& x) {
    std::vector<double> r;
    for (int i = 1; i <= 20; ++i) r.push_back(std::exp(-0.1 * i * x[0]) - std::exp(-0.08 * i));
    for (int i = 1; i <= 20; ++i) r.push_back(std::sin(0.05 * i * (x[1] - 1.6)));
    const bool is_gone = x[0] * x[1] > 2.0;
    if (is_gone) r[4] = 1.0;
    Score s = score(r);
    s.stand_ins = is_gone;
    return s;
  };
  ResidualTrustRegion method(box({0.4, 3.0}, 0.1, 5.0, Scale::linear), {.step_tolerance = 1e-5});
  Score least{.value = INFINITY};
  DesignPoint best;
  int evaluations = 0;
  for (; !method.converged() && evaluations < 100; ++evaluations) {
    const DesignPoint point = method.propose(1).front();
    const Score now = scored(point.values);
    if (now.value < least.value) {
      least = now;
      best = point;
    }
    method.observe(point, now);
  }
  EXPECT_LT(evaluations, 60);
  EXPECT_NEAR(best.values[0], 0.8, 1e-3);
  EXPECT_NEAR(best.values[1], 1.6, 1e-3);
}

TEST(ResidualTrustRegion, WhatItWantsFirstDoesNotDependOnHowManyPointsAreAskedFor) {
  for (const int outstanding : {1, 6}) {
    ResidualTrustRegion method(box({3.0, 0.4, 2.0, 0.5, 1.5}, 0.2, 4.0, Scale::logarithmic),
                               {.outstanding = outstanding});
    for (int k = 0; k < 60 && !method.converged(); ++k) {
      const DesignPoint first = method.propose(1).front();
      const std::vector<DesignPoint> plan = method.propose(9);
      EXPECT_EQ(plan.front(), first);
      for (std::size_t i = 0; i < plan.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) EXPECT_NE(plan[i], plan[j]);
      }
      method.observe(first, score(tire(first.values)));
    }
  }
}

TEST(ResidualTrustRegion, FirstPointsAreTheStartAndAProbeForEveryVariable) {
  ResidualTrustRegion method(box({1.0, 2.0, 0.5}, 0.2, 4.0, Scale::logarithmic));
  const std::vector<DesignPoint> plan = method.propose(4);
  ASSERT_EQ(plan.size(), 4u);
  for (const DesignPoint& point : plan) {
    EXPECT_EQ(method.propose(1).front(), point);
    method.observe(point, score({point.values[0], point.values[1] - 1.0, point.values[2] + 3.0}));
  }
}

TEST(ResidualTrustRegion, RefusesAScoreWithoutResidualsAndOptionsOutOfRange) {
  const DesignSpace space = box({0.5}, 0.0, 1.0, Scale::linear);
  ResidualTrustRegion method(space);
  EXPECT_THROW(method.observe(space.initial(), Score{1.0}), InputError);
  EXPECT_THROW(ResidualTrustRegion(space, {.initial_radius = 0.0}), InputError);
  EXPECT_THROW(ResidualTrustRegion(space, {.step_tolerance = 0.5}), InputError);
  EXPECT_THROW(ResidualTrustRegion(space, {.restarts = -1}), InputError);
  EXPECT_THROW(ResidualTrustRegion(space, {.outstanding = 0}), InputError);
}

}  // namespace
}  // namespace latsch
