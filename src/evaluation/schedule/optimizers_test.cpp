// SPDX-License-Identifier: Apache-2.0
// Tests that every optimizer takes the same path for any number of workers and any timing, also if
// trials fail.
#include <gtest/gtest.h>

#include "evaluation/executors/simulated_executor.h"
#include "evaluation/schedule/scheduler.h"
#include "optimization/strategy/optimizer_choice.h"

namespace latsch {
namespace {

DesignSpace optimizers_space() {
  return DesignSpace({{.name = "a", .lower = -2.0, .upper = 2.0, .initial = -1.2},
                      {.name = "b", .lower = -2.0, .upper = 2.0, .initial = 1.0},
                      {.name = "c", .lower = -2.0, .upper = 2.0, .initial = 0.5}});
}

DesignSpace constrained_space() {
  const LinearConstraint below{.name = "below", .coefficients = {1, 1, 1}, .upper = 1.5};
  const LinearConstraint across{
      .name = "across", .coefficients = {1, 0, -1}, .lower = -1.7, .upper = -0.2};
  return DesignSpace(optimizers_space().variables(), {below, across});
}

Result<Channels> valley(const DesignPoint& point) {
  const auto& x = point.values;
  Channels channels;
  channels.add({"r", "1", {10.0 * (x[1] - x[0] * x[0]), 1.0 - x[0], x[2] - 0.3 * x[1]}});
  channels.add({"c", "1", {x[0] * x[0] + x[1] * x[1] - 1.0}});
  channels.add({"dr/dx", "1", {-20.0 * x[0], 10.0, 0.0, -1.0, 0.0, 0.0, 0.0, -0.3, 1.0}});
  return channels;
}

Result<Score> sum_of_squares(const Channels& channels) {
  Score score{0.0, channels["r"]};
  for (const double r : score.residuals) score.value += r * r;
  score.constraints = channels["c"];
  return score;
}

/// Returns a score with derivatives for a method that needs them, and without them otherwise.
Result<Score> with_derivatives(const Channels& channels) {
  Score score = *sum_of_squares(channels);
  score.constraints.clear();
  score.jacobian = channels["dr/dx"];
  return score;
}

std::vector<DesignPoint> path(const std::string& method,
                              const DesignSpace& optimizers_space,
                              int outstanding,
                              int workers,
                              int timing) {
  OptimizerSettings settings;
  settings.gss.outstanding = outstanding;
  settings.residual_trust_region.outstanding = outstanding;
  settings.residual_trust_region.restarts = 1;
  OptimizerSettings gss, sqp;
  gss.method = "gss";
  sqp.method = "sqp";
  settings.members = {{"directions", 2, gss}, {"quadratic", 1, sqp}};
  settings.method = method;
  const auto optimizer = make_optimizer(
      method_of(settings,
                {.variables = 3, .has_linear_constraints = !optimizers_space.constraints().empty()})
          .method,
      optimizers_space,
      settings);
  // The seed decides which points fail, so it stays the same, and the timing is varied by the range
  // of durations.
  SimulatedExecutor executor(
      valley,
      {.workers = workers, .seed = 3, .shortest = 0.1 * timing, .longest = 2.0, .failures = 0.1});
  RunOptions options;
  options.max_steps = 60;
  std::vector<DesignPoint> points;
  for (const Step& step :
       run_optimizer(*optimizer,
                     method == "levenberg_marquardt" ? with_derivatives : sum_of_squares,
                     executor,
                     nullptr,
                     options)
           .steps) {
    points.push_back(step.point);
  }
  return points;
}

void expect_one_path(const std::string& method, const DesignSpace& optimizers_space) {
  for (const int outstanding : {1, 5}) {
    const std::vector<DesignPoint> alone = path(method, optimizers_space, outstanding, 1, 1);
    EXPECT_GT(alone.size(), 6u);  // Levenberg-Marquardt needs 8 steps
    for (const DesignPoint& point : alone) EXPECT_TRUE(optimizers_space.contains(point));
    for (const int workers : {2, 4, 8}) {
      for (const int timing : {1, 9, 19}) {
        EXPECT_EQ(path(method, optimizers_space, outstanding, workers, timing), alone) << workers;
      }
    }
  }
}

class EveryOptimizer : public testing::TestWithParam<std::string> {};

TEST_P(EveryOptimizer, TakesTheSamePathForAnyNumberOfWorkersAndAnyTiming) {
  expect_one_path(GetParam(), optimizers_space());
}

INSTANTIATE_TEST_SUITE_P(ByName, EveryOptimizer, testing::ValuesIn(method_names()));

class EveryOptimizerThatKnowsConstraints : public testing::TestWithParam<std::string> {};

TEST_P(EveryOptimizerThatKnowsConstraints, TakesTheSameFeasiblePath) {
  expect_one_path(GetParam(), constrained_space());
}

INSTANTIATE_TEST_SUITE_P(ByName,
                         EveryOptimizerThatKnowsConstraints,
                         testing::Values("gss", "sqp", "gss_nlc", "ensemble", "auto"));

}  // namespace
}  // namespace latsch
