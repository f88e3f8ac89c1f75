// SPDX-License-Identifier: Apache-2.0
#include "optimization/strategy/multi_start.h"

#include <fmt/format.h>

#include "optimization/problem/pending_points.h"

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
  Plan plan(count);
  for (const DesignPoint& point : optimizer_->propose(count)) plan.add(point);
  for (int run = run_ + 1; run <= std::ssize(starts_) && !plan.is_full(); ++run) {
    for (const DesignPoint& point : optimizer_of(run)->propose(count)) plan.add(point);
  }
  return plan.points();
}

void MultiStart::observe(const DesignPoint& point, const Result<Score>& outcome) {
  optimizer_->observe(point, outcome);
  while (optimizer_->converged() && run_ < std::ssize(starts_)) optimizer_ = optimizer_of(++run_);
}

bool MultiStart::converged() const { return optimizer_->converged(); }

}  // namespace latsch
