// SPDX-License-Identifier: Apache-2.0
// Multi-start: one run after another, each from a start of its own, such as the minima a design of
// experiments found (basins.h). The best of all runs is the result.
//
// A run is told nothing of the others: it would leave its basin for the best point known. Points it
// shares with them are not evaluated again where trials are stored.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "optimization/problem/design_space.h"
#include "optimization/problem/optimizer.h"

namespace latsch {

class MultiStart : public Optimizer {
 public:
  using MakeOptimizer = std::function<std::unique_ptr<Optimizer>(const DesignSpace&)>;

  /// Throws InputError where there is no start or one lies outside the space.
  MultiStart(const DesignSpace& space,
             std::vector<DesignPoint> starts,
             MakeOptimizer make_optimizer);

  /// Idle workers begin with the next run.
  std::vector<DesignPoint> propose(int count) const override;
  void observe(const DesignPoint& point, const Result<Score>& outcome) override;
  bool converged() const override;
  std::string ending() const override { return optimizer_->ending(); }

  /// 1, 2, ...
  int run() const { return run_; }

 private:
  DesignSpace space_;
  std::vector<DesignPoint> starts_;
  MakeOptimizer make_optimizer_;
  std::unique_ptr<Optimizer> optimizer_;
  int run_ = 0;

  std::unique_ptr<Optimizer> optimizer_of(int run) const;
};

}  // namespace latsch
