// SPDX-License-Identifier: Apache-2.0
// A search that moves some of the variables and holds the others at their start values. Its points
// are points of the whole space, so searches in different variables can share trials.
//
// The search uses a space of the free variables alone: the contributions of held variables to
// linear constraints are subtracted from the bounds of the constraints, and their columns are
// removed from Jacobians. A point proposed by another method is observed only if its held variables
// agree to the last bit.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "optimization/problem/design_space.h"
#include "optimization/problem/optimizer.h"

namespace latsch {

/// Returns the space of the free variables; the other variables are held at their initial values.
/// Throws InputError if the start is not in this space.
DesignSpace free_part(const DesignSpace& space, const std::vector<int>& free);

class HeldVariables : public Optimizer {
 public:
  using MakeOptimizer = std::function<std::unique_ptr<Optimizer>(const DesignSpace&)>;

  /// `free` holds the indices of the free variables, ascending, at least one.
  HeldVariables(const DesignSpace& space,
                std::vector<int> free,
                const MakeOptimizer& make_optimizer);

  std::vector<DesignPoint> propose(int count) const override;
  void observe(const DesignPoint& point, const Result<Score>& outcome) override;
  bool converged() const override { return optimizer_->converged(); }
  std::string ending() const override { return optimizer_->ending(); }
  std::vector<EndingClaim> claims() const override { return optimizer_->claims(); }
  std::optional<double> promise() const override { return optimizer_->promise(); }
  /// Returns minima in the whole space.
  std::vector<FoundBasin> basins() const override;
  std::string basins_in_words() const override { return optimizer_->basins_in_words(); }

 private:
  DesignPoint start_;  // start in the whole space
  std::vector<int> free_;
  std::unique_ptr<Optimizer> optimizer_;
};

}  // namespace latsch
