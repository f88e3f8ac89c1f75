// SPDX-License-Identifier: Apache-2.0
// Tests fits of a model to its own results, which contain no noise, from the search to the
// intervals: the intervals have to follow from the model and not from rounding errors. The model is
// y = a exp(b t) + c at 21 times t with the true values a = 2, b = -1.3, c = 0.5. Residuals are
// divided by 2.5, the largest value of y.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "numerics/dense/singular_values.h"
#include "optimization/identifiability/identification.h"
#include "optimization/least_squares/levenberg_marquardt.h"
#include "optimization/trust_region/residual_trust_region.h"

namespace latsch {
namespace {

using Values = std::vector<double>;
using Model = std::function<Eigen::VectorXd(const Values&)>;

constexpr double kA = 2.0, kB = -1.3, kC = 0.5, kScale = 2.5;
constexpr int kSamples = 21;

double time_of(int i) { return 0.2 * i; }

Eigen::VectorXd exponential(const Values& v) {
  Eigen::VectorXd r(kSamples);
  for (int i = 0; i < kSamples; ++i) {
    const double t = time_of(i);
    r[i] = (v[0] * std::exp(v[1] * t) + v[2] - (kA * std::exp(kB * t) + kC)) / kScale;
  }
  return r;
}

DesignVariable variable(const std::string& name, double lower, double upper, double initial) {
  return {.name = name, .lower = lower, .upper = upper, .initial = initial};
}

struct Answered {
  DesignPoint best, center;
  std::string ending;
  int trials = 0;
  Confidence confidence;
  std::vector<Interval> values;  // intervals in the units of the variables
  std::vector<Eigen::VectorXd> unknown;
};

Answered answer(const std::vector<DesignVariable>& variables,
                const Model& model,
                ConfidenceOptions options = {.least_noise = 1e-5}) {
  const DesignSpace space(variables);
  Answered found;
  ResidualTrustRegion search(space);
  double least = 1e300;
  for (; !search.converged() && found.trials < 300; ++found.trials) {
    const DesignPoint point = search.propose(1).front();
    const Eigen::VectorXd r = model(point.values);
    if (r.squaredNorm() < least) {
      least = r.squaredNorm();
      found.best = point;
    }
    search.observe(point, Score{r.squaredNorm(), {r.begin(), r.end()}});
  }
  found.ending = search.ending();
  options.traits.curves.assign(static_cast<size_t>(model(found.best.values).size()), 0);
  Identification identification(space, found.best, {.confidence = options, .profiles = false});
  while (!identification.wanted().empty()) {
    std::vector<Result<Evaluated>> outcomes;
    for (const DesignPoint& p : identification.wanted())
      outcomes.emplace_back(Evaluated(model(p.values)));
    identification.observe(outcomes);
  }
  found.center = identification.center();
  found.confidence = identification.confidence();
  found.unknown = identification.unknown_directions();
  for (int i = 0; i < space.size(); ++i) {
    const auto at = [&](double u) {
      auto moved = space.to_unit(found.center);
      moved[static_cast<size_t>(i)] = u;
      return space.from_unit(moved).values[static_cast<size_t>(i)];
    };
    const Interval& own = found.confidence.intervals[static_cast<size_t>(i)];
    found.values.push_back({at(own.lower), at(own.upper)});
  }
  return found;
}

/// Returns half the width of the interval of variable i, computed from the closed-form derivatives
/// at the true values, for noise of the size least_sigma.
double half_width(int i, const Confidence& c) {
  Eigen::MatrixXd J(kSamples, 3);
  for (int k = 0; k < kSamples; ++k) {
    const double t = time_of(k), e = std::exp(kB * t);
    J.row(k) << e / kScale, kA * t * e / kScale, 1.0 / kScale;
  }
  const auto [values, V] = numerics::singular_values(J);
  const Eigen::MatrixXd W = V * values.cwiseInverse().asDiagonal();
  return c.t * ConfidenceOptions{}.least_sigma * W.row(i).norm();
}

struct Start {
  const char* name;
  std::vector<DesignVariable> variables;
};

class FromAnyStart : public testing::TestWithParam<Start> {};

TEST_P(FromAnyStart, AllThreeNumbersAreDeterminedAsTheDesignMatrixSays) {
  const Answered found = answer(GetParam().variables, exponential);
  const double truth[] = {kA, kB, kC};
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<size_t>(i);
    EXPECT_NEAR(found.center.values[k], truth[i], 1e-7);
    EXPECT_LE(found.values[k].lower, truth[i]);
    EXPECT_GE(found.values[k].upper, truth[i]);
    const double half = half_width(i, found.confidence);
    const double own = 0.5 * (found.values[k].upper - found.values[k].lower);
    EXPECT_GE(own, 0.9 * half) << GetParam().name << " " << i;
    // The interval also contains |d|, the remaining distance to the least squares.
    EXPECT_LE(own, 6.0 * half) << GetParam().name << " " << i;
    EXPECT_EQ(found.confidence.held[k], Bound::none);
  }
  EXPECT_FALSE(found.confidence.is_colored);
}

INSTANTIATE_TEST_SUITE_P(
    ExactFit,
    FromAnyStart,
    testing::Values(
        Start{"on bounds",
              {variable("a", 0, 10, 0), variable("b", -5, 0, 0), variable("c", 0, 2, 2)}},
        Start{"a alone on its bound",
              {variable("a", 0, 10, 10), variable("b", -5, 0, -5), variable("c", 0, 2, 0)}},
        Start{"another lower bound",
              {variable("a", 0.1, 10, 0.1), variable("b", -5, 0, -5), variable("c", 0, 2, 0)}},
        Start{"inside",
              {variable("a", 0, 10, 1), variable("b", -5, 0, -1), variable("c", 0, 2, 1)}},
        Start{"logarithmic",
              {DesignVariable{.name = "a",
                              .lower = 0.01,
                              .upper = 100,
                              .initial = 0.02,
                              .scale = Scale::logarithmic},
               variable("b", -5, 0, -1),
               DesignVariable{.name = "c",
                              .lower = 1e-3,
                              .upper = 10,
                              .initial = 5,
                              .scale = Scale::logarithmic}}}),
    [](const auto& info) {
      std::string name = info.param.name;
      std::replace(name.begin(), name.end(), ' ', '_');
      return name;
    });

TEST(ExactFit, NumbersOfAnyMagnitudeAreDeterminedAlike) {
  const Answered found = answer(
      {variable("a", 0, 1e-8, 1e-9), variable("b", -5e-9, 0, -1e-9), variable("c", 0, 2e-9, 1e-9)},
      [](const Values& v) {
        return exponential({1e9 * v[0], 1e9 * v[1], 1e9 * v[2]});
      });
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<size_t>(i);
    const double own = 0.5e9 * (found.values[k].upper - found.values[k].lower);
    EXPECT_LE(own, 6.0 * half_width(i, found.confidence));
  }
}

// The true value of a variable is its bound, so only rounding errors decide if the bound holds it.
// The other variables must be determined as well as without a bound.
TEST(ExactFit, AVariableWhoseTruthIsItsBoundIsNotHeldByRounding) {
  for (const double start : {0.6, 1.0, 1.9}) {
    const Answered found =
        answer({variable("a", 0, 10, 1), variable("b", -5, 0, -1), variable("c", kC, 2, start)},
               exponential);
    EXPECT_THAT(found.confidence.held, testing::Each(Bound::none));
    EXPECT_LE(found.values[2].upper, kC + 1e-7);
    EXPECT_EQ(found.values[2].lower, kC);
    for (const size_t k : {0u, 1u})
      EXPECT_LE(found.values[k].upper - found.values[k].lower, 1e-7) << start;
  }
}

TEST(ExactFit, ResidualsThatAreExactlyZeroLeaveTheSmallestSpread) {
  const Answered found = answer(
      {variable("a", 0, 10, kA), variable("b", -5, 0, kB), variable("c", 0, 2, kC)}, exponential);
  EXPECT_EQ(found.confidence.sigma, ConfidenceOptions{}.least_sigma);
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<size_t>(i);
    const double own = 0.5 * (found.values[k].upper - found.values[k].lower);
    EXPECT_NEAR(own / half_width(i, found.confidence), 1.0, 0.01);
  }
}

TEST(ExactFit, StatedNoiseThatTheResidualsDoNotShowIsTakenAsWhite) {
  const Answered found =
      answer({variable("a", 0, 10, 10), variable("b", -5, 0, -5), variable("c", 0, 2, 0)},
             exponential,
             {.sigma = 0.01});
  EXPECT_FALSE(found.confidence.is_colored);
  const double share = 0.01 / ConfidenceOptions{}.least_sigma;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<size_t>(i);
    const double own = 0.5 * (found.values[k].upper - found.values[k].lower);
    EXPECT_NEAR(own / (share * half_width(i, found.confidence)), 1.0, 0.02);
  }
}

/// Returns the value rounded to the digits a program prints.
double printed(double value, int digits) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return std::atof(text);
}

// Only the product of two variables, or the cube of one times the other, is determined. Along the
// undetermined direction, J contains only errors of the differences, due to curvature and rounding,
// however many digits the program prints.
TEST(ExactFit, TiedVariablesMayBeAnywhereAndTheOthersNot) {
  const std::vector<DesignVariable> variables{variable("a1", 0.1, 10, 1),
                                              variable("a2", 0.1, 10, 1.5),
                                              variable("b", -5, 0, -1),
                                              variable("c", 0, 2, 1)};
  const auto rounded = [](const Values& v, int digits) {
    Eigen::VectorXd r(kSamples);
    for (int i = 0; i < kSamples; ++i) {
      const double t = time_of(i);
      r[i] = (printed(v[0] * std::exp(v[1] * t) + v[2], digits) - (kA * std::exp(kB * t) + kC)) /
             kScale;
    }
    return r;
  };
  const std::pair<Model, double> models[] = {
      {[](const Values& v) {
         return exponential({v[0] * v[1], v[2], v[3]});
       },
       2e-8},
      {[](const Values& v) {
         return exponential({v[0] + v[1], v[2], v[3]});
       },
       2e-8},
      {[](const Values& v) {
         return exponential({v[0] * std::pow(v[1], 3), v[2], v[3]});
       },
       2e-8},
      {[&](const Values& v) {
         return rounded({v[0] * v[1], v[2], v[3]}, 6);
       },
       2e-5},
  };
  int k = 0;
  for (const auto& [model, known] : models) {
    const Answered found = answer(variables, model);
    for (const size_t i : {0u, 1u}) {
      EXPECT_LE(found.confidence.intervals[i].lower, 0.0) << k << " " << i;
      EXPECT_GE(found.confidence.intervals[i].upper, 1.0) << k << " " << i;
    }
    EXPECT_LE(found.values[2].upper - found.values[2].lower, known) << k;
    EXPECT_LE(found.values[3].upper - found.values[3].lower, known) << k;
    ++k;
  }
}

// x^3 has the slope 0 at x = 0. The slope of symmetric differences is the square of their length,
// and they show no curvature. The interval must nevertheless contain the true value.
TEST(ExactFit, AVariableThatIsFlatAtItsTruthIsNotFalselyKnown) {
  const Answered found =
      answer({variable("p", -3, 3, 1), variable("q", 0, 1, 0)}, [](const Values& v) {
        Eigen::VectorXd r(8);
        for (int i = 0; i < 8; ++i) r[i] = std::pow(v[0], 3) * i / 7.0 + v[1] - 0.3;
        return r;
      });
  EXPECT_LE(found.values[0].lower, 0.0);
  EXPECT_GE(found.values[0].upper, 0.0);
}

TEST(ExactFit, AStartWithoutSlopeDoesNotHoldTheSearch) {
  const Answered found =
      answer({variable("p", -3, 3, 0), variable("q", 0, 1, 0)}, [](const Values& v) {
        Eigen::VectorXd r(8);
        for (int i = 0; i < 8; ++i) r[i] = (std::pow(v[0], 3) - 1.0) * i / 7.0 + v[1] - 0.3;
        return r;
      });
  EXPECT_NEAR(found.center.values[0], 1.0, 1e-6);
  EXPECT_LE(found.values[0].upper - found.values[0].lower, 1e-7);
}

// The ranges are so wide that the shortest steps of the search change the residuals by a large
// amount. The true value is found only as accurately as neighboring floating-point numbers of the
// range allow.
TEST(ExactFit, ARangeOfAnyWidthIsResolved) {
  for (const double wide : {1e3, 1e5, 1e7, 1e9, 1e10, 1e12}) {
    const Answered found =
        answer({variable("a", -wide, wide, 1), variable("b", -5, 0, -1), variable("c", 0, 2, 1)},
               exponential);
    EXPECT_NEAR(found.center.values[0], kA, std::max(1e-6, 1e-15 * wide)) << wide;
    EXPECT_LE(found.values[0].lower, kA) << wide;
    EXPECT_GE(found.values[0].upper, kA) << wide;
    EXPECT_GE(found.values[0].upper - found.values[0].lower, 4e-16 * wide) << wide;
    EXPECT_THAT(
        found.ending,
        testing::AnyOf(testing::HasSubstr("nothing left"), testing::HasSubstr("at a minimum")));
  }
  const Answered two =
      answer({variable("a", -1e6, 1e6, 1), variable("b", -5, 0, -1), variable("c", -1e6, 1e6, 1)},
             exponential);
  EXPECT_NEAR(two.center.values[0], kA, 1e-6);
  EXPECT_NEAR(two.center.values[2], kC, 1e-6);
  EXPECT_LT(two.trials, 150);
}

// All trials beside the start fail in x, so nothing proves that the start is a minimum in x.
TEST(ExactFit, ASearchThatSawNoSlopeDoesNotCallItsEndAMinimum) {
  const DesignSpace space({variable("x", -1e9, 1e9, 3.0), variable("y", 0, 1, 0.2)});
  ResidualTrustRegion search(space);
  for (int k = 0; !search.converged() && k < 300; ++k) {
    const DesignPoint point = search.propose(1).front();
    const double x = point.values[0], y = point.values[1];
    if (std::abs(x - 3.0) > 1e-9) {
      search.observe(point, Failure{"fails beside its start"});
    } else {
      search.observe(point, Score{1.0 + y * y, {1.0, y}});
    }
  }
  ASSERT_TRUE(search.converged());
  EXPECT_THAT(search.ending(), testing::Not(testing::HasSubstr("at a minimum")));
}

TEST(ExactFit, LevenbergMarquardtGoesOnWhereItsToleranceIsWiderThanTheWayLeft) {
  for (const double wide : {1e3, 1e7, 1e9, 1e12}) {
    const DesignSpace space(
        {variable("a", -wide, wide, 1), variable("b", -5, 0, -1), variable("c", 0, 2, 1)});
    LevenbergMarquardt search(space);
    DesignPoint best;
    double least = 1e300;
    int trials = 0;
    for (; !search.converged() && trials < 300; ++trials) {
      const DesignPoint point = search.propose(1).front();
      const Eigen::VectorXd r = exponential(point.values);
      if (r.squaredNorm() < least) {
        least = r.squaredNorm();
        best = point;
      }
      std::vector<double> slopes;
      for (int i = 0; i < kSamples; ++i) {
        const double t = time_of(i), e = std::exp(point.values[1] * t);
        for (const double s : {e, point.values[0] * t * e, 1.0}) slopes.push_back(s / kScale);
      }
      search.observe(
          point,
          Score{.value = r.squaredNorm(), .residuals = {r.begin(), r.end()}, .jacobian = slopes});
    }
    EXPECT_TRUE(search.converged());
    EXPECT_NEAR(best.values[0], kA, std::max(1e-6, 1e-15 * wide)) << wide << search.ending();
  }
}

}  // namespace
}  // namespace latsch
