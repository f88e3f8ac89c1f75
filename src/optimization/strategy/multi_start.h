// SPDX-License-Identifier: Apache-2.0
// Multi-start: several searches one after the other, each from its own start, for example from the
// minima found by a design of experiments (basins.h). The best of all runs is the result.
//
// A run does not observe the points of other runs, because it would then move to the best known
// point. If trials are stored, a point that several runs propose is evaluated once.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "optimization/problem/design_space.h"
#include "optimization/problem/optimizer.h"

namespace latsch {

class MultiStart : public Optimizer {
 public:
  /// Returns a search that starts at the initial point of the given space.
  using MakeOptimizer = std::function<std::unique_ptr<Optimizer>(const DesignSpace&)>;

  /// Throws InputError if there is no start or one lies outside the space.
  MultiStart(const DesignSpace& space,
             std::vector<DesignPoint> starts,
             MakeOptimizer make_optimizer);

  /// Proposes points of the present run and, for idle workers, of the next run.
  std::vector<DesignPoint> propose(int count) const override;
  void observe(const DesignPoint& point, const Result<Score>& outcome) override;
  bool converged() const override;
  std::string ending() const override { return optimizer_->ending(); }
  std::vector<EndingClaim> claims() const override { return optimizer_->claims(); }
  std::optional<double> promise() const override { return optimizer_->promise(); }
  std::vector<FoundBasin> basins() const override { return optimizer_->basins(); }
  std::string basins_in_words() const override { return optimizer_->basins_in_words(); }

  /// Returns the number of the present run, counted from 1.
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
