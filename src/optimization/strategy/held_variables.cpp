// SPDX-License-Identifier: Apache-2.0
#include "optimization/strategy/held_variables.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace latsch {
namespace {

std::vector<double> picked(const std::vector<double>& values, const std::vector<int>& places) {
  std::vector<double> some;
  for (const int i : places) some.push_back(values[static_cast<std::size_t>(i)]);
  return some;
}

DesignPoint in_the_whole(DesignPoint whole, const std::vector<int>& free, const DesignPoint& part) {
  for (std::size_t k = 0; k < free.size(); ++k)
    whole.values[static_cast<std::size_t>(free[k])] = part.values[k];
  return whole;
}

}  // namespace

DesignSpace free_part(const DesignSpace& space, const std::vector<int>& free) {
  std::vector<DesignVariable> variables;
  for (const int i : free) variables.push_back(space[i]);
  const DesignPoint start = space.initial();
  std::vector<LinearConstraint> constraints;
  for (LinearConstraint constraint : space.constraints()) {
    double held = constraint.sum(start.values);
    const std::vector<double> of_free = picked(constraint.coefficients, free);
    for (std::size_t k = 0; k < free.size(); ++k) held -= of_free[k] * variables[k].initial;
    const bool is_moved =
        std::any_of(of_free.begin(), of_free.end(), [](double a) { return a != 0.0; });
    if (!is_moved) continue;
    constraint.coefficients = of_free;
    constraint.lower -= held;
    constraint.upper -= held;
    constraints.push_back(std::move(constraint));
  }
  return DesignSpace(std::move(variables), std::move(constraints));
}

HeldVariables::HeldVariables(const DesignSpace& space,
                             std::vector<int> free,
                             const MakeOptimizer& make_optimizer)
    : start_(space.initial()),
      free_(std::move(free)),
      optimizer_(make_optimizer(free_part(space, free_))) {
  assert(!free_.empty() && std::is_sorted(free_.begin(), free_.end()));
}

std::vector<DesignPoint> HeldVariables::propose(int count) const {
  std::vector<DesignPoint> points;
  for (const DesignPoint& part : optimizer_->propose(count))
    points.push_back(in_the_whole(start_, free_, part));
  return points;
}

std::vector<FoundBasin> HeldVariables::basins() const {
  std::vector<FoundBasin> all = optimizer_->basins();
  for (FoundBasin& basin : all) basin.minimum = in_the_whole(start_, free_, basin.minimum);
  return all;
}

void HeldVariables::observe(const DesignPoint& point, const Result<Score>& outcome) {
  const DesignPoint part{picked(point.values, free_)};
  if (in_the_whole(start_, free_, part).bits() != point.bits()) return;
  if (!outcome || outcome->jacobian.empty()) {
    optimizer_->observe(part, outcome);
    return;
  }
  Score score = *outcome;
  score.jacobian.clear();
  const std::size_t n = start_.values.size();
  for (std::size_t row = 0; row < outcome->jacobian.size(); row += n) {
    for (const int i : free_)
      score.jacobian.push_back(outcome->jacobian[row + static_cast<std::size_t>(i)]);
  }
  optimizer_->observe(part, score);
}

}  // namespace latsch
