// SPDX-License-Identifier: Apache-2.0
#include "more_wild/more_wild_problems.h"

#include <gtest/gtest.h>

#include <cmath>

namespace latsch::more_wild {
namespace {

TEST(MoreWild, StartsAtThePublishedValues) {
  // The published f(x_0), with six digits, are those of the table distributed with the paper
  // (BenDFO, "smooth").
  const std::vector<double> published{
      7.20000e+01, 1.12500e+03, 1.16542e+07, 1.16859e+09, 4.98920e+06, 5.00936e+08, 2.42000e+01,
      1.79577e+06, 2.50000e+03, 1.06000e+04, 2.15000e+02, 1.61540e+06, 4.00500e+02, 1.54575e+08,
      4.16817e+01, 1.30623e+03, 5.31317e-03, 1.69361e+09, 1.64308e+01, 2.32337e+06, 2.69042e+01,
      8.15888e+06, 7.36782e+01, 2.05938e+07, 1.03115e+03, 4.17131e+03, 7.92669e+06, 3.08106e+11,
      4.64282e-02, 3.37706e-02, 3.86177e-02, 2.88830e-02, 3.37633e-02, 2.67406e-02, 2.73248e+02,
      1.61741e+01, 2.09342e+00, 1.99685e+02, 9.04000e+02, 1.35600e+03, 1.58200e+03, 1.80800e+03,
      5.65000e+01, 7.05625e+01, 9.86875e+01, 2.53908e+09, 6.87380e+12, 3.36796e+09, 3.73513e+09,
      3.99107e+09, 1.13001e+13, 9.38567e+00, 3.36582e+10};
  ASSERT_EQ(problems().size(), published.size());
  for (std::size_t i = 0; i < published.size(); ++i) {
    const Problem& problem = problems()[i];
    EXPECT_EQ(std::ssize(problem.residuals(problem.start)), problem.residual_count);
    EXPECT_NEAR(problem.value(problem.start) / published[i], 1.0, 5e-6) << problem.name;
  }
}

const Problem& named(const std::string& name) {
  for (const Problem& problem : problems()) {
    if (problem.name == name) return problem;
  }
  throw std::out_of_range(name);
}

TEST(MoreWild, HasItsLeastValuesWhereMoreGarbowAndHillstromSay) {
  EXPECT_EQ(named("Rosenbrock (2, 2)").value({1, 1}), 0.0);
  EXPECT_EQ(named("helical valley (3, 3)").value({1, 0, 0}), 0.0);
  EXPECT_EQ(named("Powell singular (4, 4)").value({0, 0, 0, 0}), 0.0);
  EXPECT_EQ(named("Freudenstein-Roth (2, 2)").value({5, 4}), 0.0);
  EXPECT_NEAR(named("Freudenstein-Roth (2, 2)").value({11.41278, -0.896805}), 48.98425, 1e-5);
  EXPECT_NEAR(named("Box 3-D (3, 10)").value({1, 10, 1}), 0.0, 1e-30);
  EXPECT_NEAR(named("Jennrich-Sampson (2, 10)").value({0.257825, 0.257825}), 124.3622, 1e-4);
  EXPECT_NEAR(named("Brown almost-linear (10, 10)").value(Vector(10, 1.0)), 0.0, 1e-28);
  EXPECT_NEAR(named("linear, full rank (9, 45)").value(Vector(9, -1.0)), 36.0, 1e-12);
  EXPECT_EQ(named("Cube (6, 6)").value(Vector(6, 1.0)), 0.0);
}

TEST(MoreWild, NoStartIsSolvedAndEveryBoxHoldsIt) {
  for (const Problem& problem : problems()) {
    EXPECT_GT(problem.value(problem.start), problem.solved_below(0.1)) << problem.name;
    EXPECT_EQ(space(problem).initial().values, problem.start);
  }
}

}  // namespace
}  // namespace latsch::more_wild
