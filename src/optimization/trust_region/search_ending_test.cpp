// SPDX-License-Identifier: Apache-2.0
// Tests the statements with which a search ends. The residuals are those of y = a exp(-b t) + c at
// 30 times t, with the true values a = 2, b = 1.3, c = 0.5.
#include "optimization/trust_region/search_ending.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "optimization/problem/point_vector.h"
#include "optimization/trust_region/lost_variable_trials.h"
#include "optimization/trust_region/residual_trust_region.h"

namespace latsch {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

using RippledResiduals = std::function<std::vector<double>(const std::vector<double>&)>;

std::vector<double> decay(const std::vector<double>& x) {
  std::vector<double> r;
  for (int i = 0; i < 30; ++i) {
    const double t = 0.15 * i;
    r.push_back(x[0] * std::exp(-x[1] * t) + x[2] - 2.0 * std::exp(-1.3 * t) - 0.5);
  }
  return r;
}

DesignSpace decay_space() {
  return DesignSpace({{.name = "a", .lower = 0.5, .upper = 5.0, .initial = 1.0},
                      {.name = "b", .lower = 0.2, .upper = 4.0, .initial = 0.6},
                      {.name = "c", .lower = 0.1, .upper = 3.0, .initial = 1.0}});
}

struct SearchedEnding {
  std::string words;
  std::vector<EndingClaim> claims;
  int trials = 0;
};

SearchedEnding end_of_search(const DesignSpace& space,
                             const RippledResiduals& residuals,
                             const ResidualTrustRegionOptions& options = {}) {
  LostVariableTrials search(space, options);
  SearchedEnding found;
  for (; found.trials < 500 && !search.wanted().empty(); ++found.trials) {
    const DesignPoint point = search.wanted().front().point;
    const Eigen::VectorXd u = search.wanted().front().u;
    const Eigen::VectorXd r = to_vector(residuals(point.values));
    search.observe(point, u, ResidualSample{u, r, {}, r.squaredNorm()});
  }
  found.words = in_words(search.run().ending(), search.run().evidence());
  found.claims = claims_of(search.run().ending(), search.run().evidence());
  return found;
}

std::string ending_of_search(const DesignSpace& space, const RippledResiduals& residuals) {
  return end_of_search(space, residuals).words;
}

/// Returns the claim with this statement; nullptr if there is none.
const EndingClaim* claim_of(const SearchedEnding& end, const std::string& statement) {
  for (const EndingClaim& claim : end.claims)
    if (claim.statement == statement) return &claim;
  return nullptr;
}

/// Returns the number with this name in a claim; NaN if there is none.
double number_of(const EndingClaim& claim, const std::string& name) {
  for (const ClaimNumber& number : claim.numbers)
    if (number.name == name) return number.value;
  return NAN;
}

DesignSpace decay_space_with(const DesignVariable& other) {
  std::vector<DesignVariable> variables = decay_space().variables();
  variables.push_back(other);
  return DesignSpace(variables);
}

/// Adds to every residual a part that no variable explains.
std::vector<double> with_misfit(std::vector<double> r) {
  for (std::size_t i = 0; i < r.size(); ++i) r[i] += 1e-2 * std::cos(40.0 * i);
  return r;
}

TEST(SearchEnding, OfSmoothResidualsIsAtAMinimum) {
  EXPECT_THAT(ending_of_search(decay_space(), [](const auto& x) { return with_misfit(decay(x)); }),
              StartsWith("at a minimum"));
}

TEST(SearchEnding, OfRippledResidualsIsNotAtAMinimum) {
  // The ripple is as large as a tenth of the misfit and has waves of a hundredth of the ranges, so
  // it has many minima around that of the residuals without it.
  EXPECT_THAT(ending_of_search(decay_space(),
                               [](const auto& x) {
                                 std::vector<double> r = with_misfit(decay(x));
                                 for (std::size_t i = 0; i < r.size(); ++i)
                                   r[i] += 1e-3 * std::sin(300.0 * x[0] + 250.0 * x[1] +
                                                           400.0 * x[2] + 2.4 * i);
                                 return r;
                               }),
              Not(StartsWith("at a minimum")));
}

TEST(SearchEnding, AtAMinimumHasTheNumbersOfItsTestsWithinTheirLimits) {
  const SearchedEnding end =
      end_of_search(decay_space(), [](const auto& x) { return with_misfit(decay(x)); });
  const EndingClaim* claim = claim_of(end, "at a minimum");
  ASSERT_NE(claim, nullptr);
  for (const char* name : {"predicted gain", "error of a trial between the axes"}) {
    EXPECT_FALSE(std::isnan(number_of(*claim, name))) << name;
  }
  for (const ClaimNumber& number : claim->numbers) {
    EXPECT_LE(number.value, number.at_most.value_or(1e300)) << number.name;
  }
  EXPECT_EQ(claim_of(end, "at a bound"), nullptr);
  EXPECT_EQ(claim_of(end, "flat"), nullptr);
}

// The model is exact and the true amplitude of 2 lies beyond the upper bound.
TEST(SearchEnding, AtABoundIsSaidOfAVariableWhoseTrueValueIsBeyond) {
  const DesignSpace space({{.name = "a", .lower = 0.0, .upper = 1.5, .initial = 1.0},
                           {.name = "b", .lower = 0.2, .upper = 4.0, .initial = 0.6},
                           {.name = "c", .lower = 0.1, .upper = 3.0, .initial = 1.0}});
  const SearchedEnding end = end_of_search(space, decay);
  const EndingClaim* claim = claim_of(end, "at a bound");
  ASSERT_NE(claim, nullptr) << end.words;
  EXPECT_EQ(claim->variables, std::vector<std::string>{"a"});
  EXPECT_GT(number_of(*claim, "rise"), 0.0);
  EXPECT_GT(number_of(*claim, "slope"), 1.0);
  EXPECT_THAT(end.words, HasSubstr("\"a\" is at the upper bound"));
}

// The residuals beside the bound are large and strongly curved, which scatters them around a linear
// model as noise would.
TEST(SearchEnding, OfACurvedModelBesideABoundIsNotInTheNoise) {
  const DesignSpace space({{.name = "a", .lower = 0.0, .upper = 1.5, .initial = 1.0},
                           {.name = "b", .lower = -5.0, .upper = 0.0, .initial = -1.0},
                           {.name = "c", .lower = 0.0, .upper = 2.0, .initial = 1.0}});
  const SearchedEnding end = end_of_search(space, [](const std::vector<double>& x) {
    std::vector<double> r;
    for (int i = 0; i < 21; ++i) {
      const double t = 0.2 * i;
      const double y = x[0] * std::exp(x[1] * t) + x[2] - 2.0 * std::exp(-1.3 * t) - 0.5;
      r.push_back(y / 2.5 / std::sqrt(21.0));
    }
    return r;
  });
  EXPECT_THAT(end.words, StartsWith("at a minimum"));
  ASSERT_NE(claim_of(end, "at a bound"), nullptr) << end.words;
}

TEST(SearchEnding, OfNoisyResidualsIsInTheNoise) {
  const SearchedEnding end = end_of_search(decay_space(), [](const std::vector<double>& x) {
    std::vector<double> r = with_misfit(decay(x));
    double phase = 0.0;
    for (const double value : x) phase = 1e3 * std::sin(1e6 * value + phase);
    for (double& value : r) value += 2e-3 * std::sin(phase = 1e3 * std::sin(phase + 1.0));
    return r;
  });
  EXPECT_THAT(end.words, StartsWith("in the noise"));
}

// The true amplitude lies on the bound, so the slope there is zero and does not point out.
TEST(SearchEnding, AtABoundIsNotSaidOfAVariableWhoseTrueValueIsThere) {
  const DesignSpace space({{.name = "a", .lower = 0.0, .upper = 2.0, .initial = 1.0},
                           {.name = "b", .lower = 0.2, .upper = 4.0, .initial = 0.6},
                           {.name = "c", .lower = 0.1, .upper = 3.0, .initial = 1.0}});
  EXPECT_EQ(claim_of(end_of_search(space, decay), "at a bound"), nullptr);
}

TEST(SearchEnding, FlatIsSaidOfAVariableWithoutEffectAlone) {
  const DesignSpace space =
      decay_space_with({.name = "idle", .lower = 0.0, .upper = 1.0, .initial = 0.4});
  const SearchedEnding end =
      end_of_search(space, [](const auto& x) { return with_misfit(decay(x)); });
  const EndingClaim* claim = claim_of(end, "flat");
  ASSERT_NE(claim, nullptr) << end.words;
  EXPECT_EQ(claim->variables, std::vector<std::string>{"idle"});
  EXPECT_NEAR(number_of(*claim, "longest move"), 0.3, 1e-6);
  EXPECT_THAT(end.words, HasSubstr("\"idle\" is without effect here"));
}

// A variable that has an effect from 0.55 on is not flat, although its slope at 0.4 is zero.
TEST(SearchEnding, FlatIsNotSaidOfAVariableThatActsFartherOff) {
  const DesignSpace space =
      decay_space_with({.name = "stop", .lower = 0.0, .upper = 1.0, .initial = 0.4});
  const SearchedEnding end = end_of_search(space, [](const auto& x) {
    std::vector<double> r = with_misfit(decay(x));
    r[3] += std::max(0.0, x[3] - 0.55);
    r[3] += std::max(0.0, 0.1 - x[3]);
    return r;
  });
  EXPECT_EQ(claim_of(end, "flat"), nullptr) << end.words;
}

TEST(SearchEnding, WithNothingLeftNamesAVariableWithoutEffect) {
  const DesignSpace space =
      decay_space_with({.name = "idle", .lower = 0.0, .upper = 1.0, .initial = 0.4});
  const SearchedEnding end = end_of_search(space, decay);
  EXPECT_THAT(end.words, StartsWith("with nothing left"));
  EXPECT_THAT(end.words, HasSubstr("but \"idle\" is not determined"));
  ASSERT_NE(claim_of(end, "not determined"), nullptr);
  EXPECT_EQ(claim_of(end, "not determined")->variables, std::vector<std::string>{"idle"});
  ASSERT_NE(claim_of(end, "flat"), nullptr) << end.words;
  EXPECT_EQ(claim_of(end, "flat")->variables, std::vector<std::string>{"idle"});
  EXPECT_LT(number_of(*claim_of(end, "with nothing left"), "left"), 1e-8);
}

// The residuals know only the product of a and d.
TEST(SearchEnding, WithNothingLeftNamesBothVariablesOfAProduct) {
  const DesignSpace space({{.name = "a", .lower = 0.1, .upper = 10.0, .initial = 1.0},
                           {.name = "d", .lower = 0.1, .upper = 10.0, .initial = 1.5},
                           {.name = "b", .lower = 0.2, .upper = 4.0, .initial = 0.6},
                           {.name = "c", .lower = 0.1, .upper = 3.0, .initial = 1.0}});
  const SearchedEnding end = end_of_search(space, [](const std::vector<double>& x) {
    return decay({x[0] * x[1], x[2], x[3]});
  });
  EXPECT_THAT(end.words, StartsWith("with nothing left"));
  ASSERT_NE(claim_of(end, "not determined"), nullptr) << end.words;
  EXPECT_THAT(claim_of(end, "not determined")->variables, testing::ElementsAre("a", "d"));
}

TEST(SearchEnding, WithNothingLeftNamesNoVariableThatTheDataHold) {
  const std::string words = ending_of_search(decay_space(), decay);
  EXPECT_THAT(words, StartsWith("with nothing left"));
  EXPECT_THAT(words, Not(HasSubstr("not determined")));
}

// r = (x^2 - 1, 0.2 (x - 1), y) has a minimum with S = 0 near x = 1 and one with S = 0.16 near
// x = -1; halfway between them S is 1.
TEST(SearchEnding, TellsASecondMinimumBeyondARidge) {
  const DesignSpace space({{.name = "x", .lower = -2.0, .upper = 2.0, .initial = -1.5},
                           {.name = "y", .lower = -1.0, .upper = 1.0, .initial = 0.5}});
  ResidualTrustRegionOptions options;
  options.restarts = 8;
  options.initial_radius = 0.4;
  int told = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    options.seed = seed;
    const SearchedEnding end = end_of_search(
        space,
        [](const auto& x) {
          std::vector<double> r{x[0] * x[0] - 1.0, 0.2 * (x[0] - 1.0), x[1]};
          for (int i = 0; i < 20; ++i) r.push_back(0.02 * std::cos(40.0 * i));
          return r;
        },
        options);
    const EndingClaim* claim = claim_of(end, "several minima");
    if (!claim) continue;
    ++told;
    EXPECT_GT(number_of(*claim, "distance"), 0.4);  // 2 of a range of 4
    EXPECT_THAT(end.words, HasSubstr("another minimum"));
  }
  EXPECT_GT(told, 0);
}

// One valley alone: no end lies beyond a ridge, however many restarts there are.
TEST(SearchEnding, TellsNoSecondMinimumOfOneValley) {
  const SearchedEnding end =
      end_of_search(decay_space(), [](const auto& x) { return with_misfit(decay(x)); });
  EXPECT_EQ(claim_of(end, "several minima"), nullptr) << end.words;
}

TEST(SearchEnding, OfASearchThatIsStoppedPromisesWhatItsNextStepGains) {
  ResidualTrustRegion search(decay_space());
  double least = 1e300, promised = 0.0;
  bool was_step = false;
  int kept = 0, promises = 0;
  for (int k = 0; k < 40 && !search.converged(); ++k) {
    const auto promise = search.promise();
    const DesignPoint point = search.propose(1).front();
    const std::vector<double> r = with_misfit(decay(point.values));
    double f = 0.0;
    for (const double value : r) f += value * value;
    was_step = promise && f < least;
    promised = promise.value_or(0.0);
    EXPECT_GE(promised, 0.0);
    EXPECT_LE(promised, 1.0);
    promises += promise.has_value();
    kept += was_step && 1.0 - f / least > 0.5 * promised;
    least = std::min(least, f);
    search.observe(point, Score{f, r});
  }
  EXPECT_GT(promises, 0);
  EXPECT_GT(kept, 0);
  while (!search.converged()) {
    const DesignPoint point = search.propose(1).front();
    const std::vector<double> r = with_misfit(decay(point.values));
    double f = 0.0;
    for (const double value : r) f += value * value;
    search.observe(point, Score{f, r});
  }
  EXPECT_EQ(search.promise(), std::nullopt);
}

}  // namespace
}  // namespace latsch
