// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "identification_set/disturbed_problem.h"
#include "optimization/design/sobol.h"

namespace latsch::identification_set {
namespace {

TEST(IdentificationSet, HasFortyProblemsHalfOfThemHeldOutAndNoneTwice) {
  const std::vector<Problem> all = problems();
  EXPECT_GE(all.size(), 40u);
  EXPECT_EQ(tuning_problems().size(), held_out_problems().size());
  std::set<std::string> names;
  for (const Problem& problem : all) {
    names.insert(problem.name);
    EXPECT_GE(problem.n(), 2) << problem.name;
    EXPECT_LE(problem.n(), 15) << problem.name;
  }
  EXPECT_EQ(names.size(), all.size());
}

TEST(IdentificationSet, TheTruthExplainsTheDataAndTheStartDoesNot) {
  for (const Problem& problem : problems()) {
    const DisturbedProblem smooth(problem, Variant::smooth, 0);
    const double start = smooth.exact(problem.space.initial().values);
    EXPECT_TRUE(std::isfinite(start)) << problem.name;
    // The errors of the data are at most 1 %, and 0.1 % unless stated otherwise.
    EXPECT_LT(smooth.exact(problem.truth), 0.02 * start) << problem.name;
    EXPECT_EQ(smooth.shown(problem.truth)->size(),
              smooth.shown(problem.space.initial().values)->size());
  }
}

TEST(IdentificationSet, OfLostVariablesNothingIsFeltAtTheStart) {
  for (const Problem& problem : lost_problems()) {
    const DisturbedProblem smooth(problem, Variant::smooth, 0);
    const std::vector<double> start = problem.space.to_unit(problem.space.initial());
    EXPECT_LT(smooth.exact(problem.truth), 0.02 * smooth.exact(problem.space.initial().values));
    const auto norm = [&](int i, double by) {
      std::vector<double> u = start;
      u[i] += u[i] > 0.5 ? -by : by;
      const Vector r = problem.residuals(problem.space.from_unit(u).values);
      const Vector r0 = problem.residuals(problem.space.initial().values);
      double sum = 0.0;
      for (std::size_t k = 0; k < r.size(); ++k) sum += std::pow(r[k] - r0[k], 2);
      return std::sqrt(sum);
    };
    double least = INFINITY, most = 0.0;
    for (int i = 0; i < problem.n(); ++i) {
      least = std::min(least, norm(i, 0.01));
      most = std::max(most, norm(i, 0.01));
    }
    EXPECT_LT(least, 0.1 * most) << problem.name;
  }
}

TEST(IdentificationSet, ACornerOfTwelveToFifteenPercentFailsNotTheStart) {
  int number = 0, truths = 0;
  for (const Problem& problem : problems()) {
    const DisturbedProblem failing(problem, Variant::failing, number++);
    ASSERT_FALSE(failing.corner().empty()) << problem.name;
    EXPECT_FALSE(failing.fails(problem.space.initial().values)) << problem.name;
    truths += failing.fails(problem.truth);
    int failed = 0;
    const auto points = sobol(problem.space, 2048, 5).points;
    for (const DesignPoint& point : points) failed += failing.fails(point.values);
    const double share = failed / 2048.0;
    EXPECT_GT(share, 0.12) << problem.name;
    EXPECT_LT(share, 0.15) << problem.name;
  }
  EXPECT_GT(truths, 8);
}

TEST(IdentificationSet, RippleAndNoiseAreSmallAndTheSameAgain) {
  int number = 0;
  for (const Problem& problem : problems()) {
    const Vector start = problem.space.initial().values;
    const Vector smooth = problem.residuals(start);
    for (const Variant variant : {Variant::rough, Variant::noisy}) {
      const DisturbedProblem disturbed(problem, variant, number++);
      const Vector r = *disturbed.shown(start);
      EXPECT_EQ(r, *disturbed.shown(start));
      double off = 0.0, f = 0.0;
      for (std::size_t i = 0; i < r.size(); ++i) {
        off += std::pow(r[i] - smooth[i], 2);
        f += std::pow(smooth[i], 2);
      }
      EXPECT_GT(std::sqrt(off / f), 1e-4) << problem.name;
      EXPECT_LT(std::sqrt(off / f), 6e-3) << problem.name;
    }
  }
}

}  // namespace
}  // namespace latsch::identification_set
