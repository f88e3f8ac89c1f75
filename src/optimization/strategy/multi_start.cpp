// SPDX-License-Identifier: Apache-2.0
#include "optimization/strategy/multi_start.h"

#include <fmt/format.h>

#include <algorithm>

namespace latsch {

MultiStart::MultiStart(const DesignSpace& space,
                       std::vector<DesignPoint> starts,
                       MakeOptimizer make_optimizer)
    : space_(space), starts_(std::move(starts)), make_optimizer_(std::move(make_optimizer)) {
  if (starts_.empty()) throw InputError("multi-start: there is no start, expected one or more");
  for (std::size_t i = 0; i < starts_.size(); ++i) {
    if (space_.contains(starts_[i])) continue;
    throw InputError(
        fmt::format("multi-start: start {} lies outside the bounds or constraints", i + 1));
  }
  optimizer_ = optimizer_of(++run_);
}

std::unique_ptr<Optimizer> MultiStart::optimizer_of(int run) const {
  return make_optimizer_(space_.starting_at(starts_[run - 1]));
}

std::vector<DesignPoint> MultiStart::propose(int count) const {
  std::vector<DesignPoint> plan = optimizer_->propose(count);
  for (int run = run_ + 1; run <= std::ssize(starts_) && std::ssize(plan) < count; ++run) {
    for (const DesignPoint& point : optimizer_of(run)->propose(count)) {
      const bool is_named = std::find(plan.begin(), plan.end(), point) != plan.end();
      if (std::ssize(plan) < count && !is_named) plan.push_back(point);
    }
  }
  return plan;
}

void MultiStart::observe(const DesignPoint& point, const Result<Score>& outcome) {
  optimizer_->observe(point, outcome);
  while (optimizer_->converged() && run_ < std::ssize(starts_)) optimizer_ = optimizer_of(++run_);
}

bool MultiStart::converged() const { return optimizer_->converged(); }

}  // namespace latsch
