// SPDX-License-Identifier: Apache-2.0
#include "optimization/strategy/ensemble.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "optimization/direct_search/genetic.h"
#include "optimization/direct_search/gss.h"
#include "optimization/direct_search/nelder_mead.h"

namespace latsch {
namespace {

DesignSpace plane(double start = 0.8) {
  return DesignSpace({{.name = "a", .lower = -1.0, .upper = 1.0, .initial = start},
                      {.name = "b", .lower = -1.0, .upper = 1.0, .initial = start}});
}

/// A function with two minima of different depth near (0.6, 0.6) and (-0.6, -0.6); the second one
/// is deeper.
double two_basins(const std::vector<double>& x) {
  const double near = std::hypot(x[0] - 0.6, x[1] - 0.6);
  const double far = std::hypot(x[0] + 0.6, x[1] + 0.6);
  return std::min(0.5 + near, 2.0 * far);
}

/// An optimizer that proposes the points of a grid one after the other and records all points it
/// observes.
class Marcher : public Optimizer {
 public:
  Marcher(double first, int steps) : first_(first), steps_(steps) {}
  std::vector<DesignPoint> propose(int count) const override {
    std::vector<DesignPoint> plan;
    for (int k = step_; k < std::min(steps_, step_ + count); ++k) plan.push_back(point(k));
    return plan;
  }
  void observe(const DesignPoint& told, const Result<Score>&) override {
    ++told_;
    if (step_ < steps_ && told == point(step_)) ++step_;
  }
  bool converged() const override { return step_ == steps_; }
  int told() const { return told_; }

 private:
  DesignPoint point(int k) const { return {{first_ + k, 0.0}}; }
  double first_;
  int steps_, step_ = 0, told_ = 0;
};

EnsembleMember member(Optimizer* owned, int priority = 1) {
  return {std::unique_ptr<Optimizer>(owned), priority};
}

template <class... Members>
std::vector<EnsembleMember> members(Members... each) {
  std::vector<EnsembleMember> all;
  (all.push_back(std::move(each)), ...);
  return all;
}

TEST(Ensemble, SharesStepsByPriorityAndTellsEverybodyEverything) {
  auto* often = new Marcher(0, 100);
  auto* seldom = new Marcher(1000, 100);
  Ensemble ensemble(members(member(often, 3), member(seldom, 1)));
  for (int k = 0; k < 40; ++k) ensemble.observe(ensemble.propose(1).front(), Score{1.0});
  EXPECT_EQ(ensemble.turns(), (std::vector<long>{30, 10}));
  EXPECT_EQ(often->told(), 40);
  EXPECT_EQ(seldom->told(), 40);
  while (!ensemble.converged()) ensemble.observe(ensemble.propose(1).front(), Score{1.0});
  EXPECT_EQ(ensemble.turns(), (std::vector<long>{100, 100}));
  EXPECT_TRUE(ensemble.propose(3).empty());
}

TEST(Ensemble, MayEndWithTheFirst) {
  Ensemble ensemble(members(member(new Marcher(0, 5), 1), member(new Marcher(50, 99), 1)),
                    Ensemble::End::first);
  int steps = 0;
  for (; !ensemble.converged(); ++steps) ensemble.observe(ensemble.propose(1).front(), Score{});
  EXPECT_EQ(steps, 9);
}

TEST(Ensemble, AsksForNoPointTwice) {
  Ensemble ensemble(members(member(new Marcher(0, 30), 1), member(new Marcher(10, 30), 2)));
  std::set<std::string> asked;
  while (!ensemble.converged()) {
    const DesignPoint point = ensemble.propose(1).front();
    EXPECT_TRUE(asked.insert(point.bits()).second);
    ensemble.observe(point, Score{1.0});
  }
  EXPECT_EQ(asked.size(), 40u);
}

TEST(Ensemble, FirstDoesNotDependOnHowManyPointsAreAskedFor) {
  Ensemble ensemble(members(member(new Gss(plane()), 2),
                            member(new NelderMead(plane()), 1),
                            member(new Genetic(plane(), {.generations = 4}), 1)));
  int steps = 0;
  for (; !ensemble.converged() && steps < 2000; ++steps) {
    const auto plan = ensemble.propose(7);
    EXPECT_EQ(ensemble.propose(1).front(), plan.front());
    for (size_t i = 0; i < plan.size(); ++i) {
      for (size_t j = 0; j < i; ++j) EXPECT_NE(plan[i], plan[j]);
    }
    ensemble.observe(plan.front(), Score{two_basins(plan.front().values)});
  }
  EXPECT_TRUE(ensemble.converged());
}

TEST(Ensemble, AFineSearchFinishesWhatACoarseOneFound) {
  // The direct search alone ends in the local minimum near its start.
  const auto least = [](Optimizer& optimizer) {
    double f = INFINITY;
    while (!optimizer.converged()) {
      const DesignPoint point = optimizer.propose(1).front();
      f = std::min(f, two_basins(point.values));
      optimizer.observe(point, Score{two_basins(point.values)});
    }
    return f;
  };
  Gss alone(plane());
  EXPECT_NEAR(least(alone), 0.5, 5e-3);
  Genetic coarse(plane(), {.population = 60, .generations = 2});
  EXPECT_GT(least(coarse), 0.01);
  Ensemble both(members(member(new Gss(plane()), 1),
                        member(new Genetic(plane(), {.population = 60, .generations = 2}), 1)));
  EXPECT_LT(least(both), 5e-3);
}

TEST(Ensemble, RefusesNobodyAndPrioritiesBelowOne) {
  EXPECT_THROW(Ensemble(std::vector<EnsembleMember>{}), InputError);
  EXPECT_THROW(Ensemble(members(member(new Marcher(0, 1), 0))), InputError);
}

}  // namespace
}  // namespace latsch
