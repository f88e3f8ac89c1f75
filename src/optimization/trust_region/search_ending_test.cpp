// SPDX-License-Identifier: Apache-2.0
// Tests the statements with which a search ends. The residuals are those of y = a exp(-b t) + c at
// 30 times t, with the true values a = 2, b = 1.3, c = 0.5.
#include "optimization/trust_region/search_ending.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "optimization/trust_region/residual_trust_region.h"

namespace latsch {
namespace {

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

std::string ending_of_search(const DesignSpace& space, const RippledResiduals& residuals) {
  ResidualTrustRegion search(space);
  for (int k = 0; k < 500 && !search.converged(); ++k) {
    const DesignPoint point = search.propose(1).front();
    const std::vector<double> r = residuals(point.values);
    double f = 0.0;
    for (const double value : r) f += value * value;
    search.observe(point, Score{f, r});
  }
  return search.ending();
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

}  // namespace
}  // namespace latsch
