// SPDX-License-Identifier: Apache-2.0
#include "optimization/strategy/cascade.h"

#include <fmt/format.h>

namespace latsch {

Cascade::Cascade(const DesignSpace& space, CascadeOptions options, MakeOptimizer make_optimizer)
    : options_(options), make_optimizer_(std::move(make_optimizer)), space_(space) {
  if (options_.stages < 1) {
    throw InputError(fmt::format("cascade: {} stages, expected 1 or more", options_.stages));
  }
  if (!(options_.tightening > 0.0 && options_.tightening < 1.0)) {
    throw InputError(
        fmt::format("cascade: tightening is {}, expected between 0 and 1", options_.tightening));
  }
  optimizer_ = make_optimizer_(space_);
}

std::vector<DesignPoint> Cascade::propose(int count) const { return optimizer_->propose(count); }

void Cascade::observe(const DesignPoint& point, const Result<Score>& outcome) {
  if (outcome && (!best_ || is_better(*outcome, best_->score))) best_ = Best{point, *outcome};
  optimizer_->observe(point, outcome);
  while (optimizer_->converged() && stage_ < options_.stages && best_) {
    ++stage_;
    space_ = space_.tightened(best_->point, options_.tightening);
    optimizer_ = make_optimizer_(space_);
    optimizer_->observe(best_->point, best_->score);
  }
}

bool Cascade::converged() const { return optimizer_->converged(); }

}  // namespace latsch
