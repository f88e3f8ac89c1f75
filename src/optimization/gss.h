// SPDX-License-Identifier: Apache-2.0
// Generating-set search: polls around the best point along directions that span the space, with a
// step length of its own for each; a point counts as better only if it gains alpha step^2; a
// direction that fails contracts its step.
#pragma once

#include <memory>
#include <vector>

#include "optimization/design_space.h"
#include "optimization/optimizer.h"

namespace latsch {

/// Lengths are in the unit cube: 1 is the whole range of a variable.
struct GssOptions {
  double initial_step = 0.2;
  double step_tolerance = 1e-3;  // converged when every direction has failed with a step this short
  double contraction = 0.5;
  double sufficient_decrease = 0.01;  // alpha in  f(x + step d) < f(x) - alpha step^2
};

class Gss : public Optimizer {
 public:
  /// Throws InputError for options out of range.
  Gss(const DesignSpace& space, const GssOptions& options = {});
  ~Gss() override;

  std::vector<DesignPoint> propose(int count) const override;
  void observe(const DesignPoint& point, const Result<Score>& outcome) override;
  bool converged() const override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace latsch
