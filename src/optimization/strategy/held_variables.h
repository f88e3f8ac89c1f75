// SPDX-License-Identifier: Apache-2.0
// A search that moves some of the variables and holds the others at their start values. Points
// remain points of the whole space, so searches in different variables share their trials.
//
// The search uses a space of the free variables alone: the contributions of held variables to
// linear constraints are moved to their bounds, and their columns are removed from Jacobians. It
// observes points proposed by others only if their held variables agree to the last bit.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "optimization/problem/design_space.h"
#include "optimization/problem/optimizer.h"

namespace latsch {

/// Returns the space of the free variables, with the others at their initial values. Throws
/// InputError if the start is outside of it.
DesignSpace free_part(const DesignSpace& space, const std::vector<int>& free);

class HeldVariables : public Optimizer {
 public:
  using MakeOptimizer = std::function<std::unique_ptr<Optimizer>(const DesignSpace&)>;

  /// `free` holds indices of variables in the space, ascending, at least one.
  HeldVariables(const DesignSpace& space,
                std::vector<int> free,
                const MakeOptimizer& make_optimizer);

  std::vector<DesignPoint> propose(int count) const override;
  void observe(const DesignPoint& point, const Result<Score>& outcome) override;
  bool converged() const override { return optimizer_->converged(); }
  std::string ending() const override { return optimizer_->ending(); }

 private:
  DesignPoint start_;  // point of the whole space
  std::vector<int> free_;
  std::unique_ptr<Optimizer> optimizer_;
};

}  // namespace latsch
