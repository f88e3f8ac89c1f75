// SPDX-License-Identifier: Apache-2.0
#include "optimization/strategy/cascade.h"

#include <gtest/gtest.h>

#include <cmath>

#include "optimization/direct_search/gss.h"

namespace latsch {
namespace {

DesignSpace space() {
  return DesignSpace({{.name = "a", .lower = -4.0, .upper = 4.0, .initial = 3.0},
                      {.name = "b", .lower = -4.0, .upper = 4.0, .initial = -3.0}});
}

double bowl(const DesignPoint& point) {
  return std::abs(point.values[0] - 1.0) + std::abs(point.values[1] - 0.5);
}

struct Ended {
  double best = INFINITY;
  int evaluations = 0;
};

Ended run(Optimizer& optimizer) {
  Ended ended;
  while (!optimizer.converged()) {
    const DesignPoint point = optimizer.propose(1).front();
    const double value = bowl(point);
    optimizer.observe(point, Score{value});
    ended.best = std::min(ended.best, value);
    ++ended.evaluations;
  }
  return ended;
}

std::unique_ptr<Optimizer> coarse(const DesignSpace& space) {
  return std::make_unique<Gss>(space, GssOptions{.step_tolerance = 0.02});
}

TEST(Cascade, LaterStagesStartAtTheBestPointAndSearchMoreFinely) {
  const auto single = coarse(space());
  Cascade cascade(space(), {.stages = 3, .tightening = 0.2}, coarse);
  const Ended first = run(*single);
  const Ended third = run(cascade);
  EXPECT_EQ(cascade.stage(), 3);
  EXPECT_LT(third.best, 0.2 * first.best);
  // Two stages have narrowed the width of 8 to a fifth each.
  EXPECT_NEAR(cascade.space()[0].upper - cascade.space()[0].lower, 8.0 / 25.0, 1e-12);
}

TEST(Cascade, OneStageIsTheOptimizerAlone) {
  const auto single = coarse(space());
  Cascade cascade(space(), {.stages = 1}, coarse);
  while (!single->converged()) {
    const DesignPoint point = single->propose(1).front();
    ASSERT_EQ(cascade.propose(1).front(), point);
    single->observe(point, Score{bowl(point)});
    cascade.observe(point, Score{bowl(point)});
  }
  EXPECT_TRUE(cascade.converged());
}

TEST(Cascade, EndsWhereEverythingFails) {
  Cascade cascade(space(), {.stages = 3}, coarse);
  while (!cascade.converged()) cascade.observe(cascade.propose(1).front(), Failure{"no"});
  EXPECT_EQ(cascade.stage(), 1);
}

TEST(Cascade, RejectsOptionsOutOfRange) {
  EXPECT_THROW(Cascade(space(), {.stages = 0}, coarse), InputError);
  EXPECT_THROW(Cascade(space(), {.tightening = 1.0}, coarse), InputError);
}

}  // namespace
}  // namespace latsch
