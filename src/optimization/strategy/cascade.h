// SPDX-License-Identifier: Apache-2.0
// Cascade: several searches one after the other, each within tightened bounds around the result of
// the one before.
//
// Each stage is a separate optimizer on the space of the stage before, narrowed by a factor in the
// unit cube. It observes the value of the point it starts from. The steps of a stage are relative
// to its own, narrower cube, so the same options search more finely. [Hempel, Oertel, KGK 04/2016]
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "optimization/problem/design_space.h"
#include "optimization/problem/optimizer.h"

namespace latsch {

/// Number of stages, and the width of their bounds.
struct CascadeOptions {
  int stages = 2;            // number of searches, one after the other
  double tightening = 0.25;  // width of a stage's bounds relative to those of the stage before
};

class Cascade : public Optimizer {
 public:
  /// Returns the optimizer of one stage for a space with the bounds of that stage.
  using MakeOptimizer = std::function<std::unique_ptr<Optimizer>(const DesignSpace&)>;

  /// Throws InputError for less than one stage or a tightening that is not between 0 and 1.
  Cascade(const DesignSpace& space, CascadeOptions options, MakeOptimizer make_optimizer);

  /// Proposes points of the present stage only.
  std::vector<DesignPoint> propose(int count) const override;
  void observe(const DesignPoint& point, const Result<Score>& outcome) override;
  bool converged() const override;
  std::string ending() const override { return optimizer_->ending(); }
  std::vector<EndingClaim> claims() const override { return optimizer_->claims(); }
  std::optional<double> promise() const override { return optimizer_->promise(); }
  std::vector<FoundBasin> basins() const override { return optimizer_->basins(); }
  std::string basins_in_words() const override { return optimizer_->basins_in_words(); }

  /// Returns the number of the present stage, counted from 1.
  int stage() const { return stage_; }
  /// Returns the space with the bounds of the present stage.
  const DesignSpace& space() const { return space_; }

 private:
  struct Best {
    DesignPoint point;
    Score score;
  };

  CascadeOptions options_;
  MakeOptimizer make_optimizer_;
  DesignSpace space_;
  std::unique_ptr<Optimizer> optimizer_;
  std::optional<Best> best_;
  int stage_ = 1;
};

}  // namespace latsch
