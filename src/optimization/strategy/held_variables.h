// SPDX-License-Identifier: Apache-2.0
// A search that moves some of the variables and leaves the others where the start has them. Points
// stay points of the whole space, so trials of searches in different variables know of each other.
//
// The search sees a space of the free variables alone: linear constraints with what the held ones
// contribute taken to their bounds, Jacobians without their columns. Of points that others asked
// for it is told those in which the held variables are where they are here, to the last bit.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "optimization/problem/design_space.h"
#include "optimization/problem/optimizer.h"

namespace latsch {

/// The space of the free variables, the others at their initial values. Throws InputError where the
/// start is outside of it.
DesignSpace free_part(const DesignSpace& space, const std::vector<int>& free);

class HeldVariables : public Optimizer {
 public:
  using MakeOptimizer = std::function<std::unique_ptr<Optimizer>(const DesignSpace&)>;

  /// `free`: places in the space, ascending, one at least.
  HeldVariables(const DesignSpace& space,
                std::vector<int> free,
                const MakeOptimizer& make_optimizer);

  std::vector<DesignPoint> propose(int count) const override;
  void observe(const DesignPoint& point, const Result<Score>& outcome) override;
  bool converged() const override { return optimizer_->converged(); }
  std::string ending() const override { return optimizer_->ending(); }

 private:
  DesignPoint start_;  // of the whole space
  std::vector<int> free_;
  std::unique_ptr<Optimizer> optimizer_;
};

}  // namespace latsch
