// SPDX-License-Identifier: Apache-2.0
// Generating-set search with a model step: direct search for target functions with kinks, valleys
// and points that fail, at some dozens of evaluations for a few variables.
//
// In the unit cube, around the best point x with value f and along directions d_i with steps D_i:
//
//   poll     x + D_i d_i, cut off at the bounds, longest step first, from the direction of the last
//            success to its opposite. Better means  f(new) < f - alpha D_i^2  (sufficient
//            decrease).
//   success  x moves there; a fresh set of directions starts with that step, a longer one where
//            success follows success.
//   failure  D_i is contracted. When all directions failed at one length, the set is turned.
//   search   after every outcome but its own failure: the least value, within reach of the step, of
//            a quadratic through the evaluated points nearest to x. It counts by the same rule.
//   end      when every direction failed with a step below the tolerance.
//
// Among linear constraints the directions conform to those within a step of x (conforming_set.h),
// steps are cut off at the constraints, points very near to some are snapped onto them, and the
// model is made least among them (model_step.h). So every point asked for is feasible. [Lewis,
// Shepherd, Torczon, SIAM J. Sci. Comput. 29 (2007) 2507]
//
// Polling alone makes it converge, for any search step [Kolda, Lewis, Torczon, SIAM Review 45
// (2003) 385]. Steps for each direction, sufficient decrease and its factor are those of
// HOPSPACK 2.0 [Plantenga, SAND2009-6265]; turned directions and the model step are what a sum of
// absolute residuals needs. Such a sum grows from its minimum like a norm, so the model is one of
// f^2, which a quadratic fits at both sides of the kinks; where values are negative it is one of f.
//
// It is asynchronous: `outstanding` points are under way at any time, whatever the number of
// workers; each was chosen with the outcomes known then, and each counts when its turn comes, also
// where x has moved on meanwhile. An outcome that is a Failure counts as infinite and stays out of
// the model. Speculation assumes that the outcomes it waits for bring nothing.
#pragma once

#include <memory>
#include <vector>

#include "optimization/problem/design_space.h"
#include "optimization/problem/optimizer.h"

namespace latsch {

/// Lengths are in the unit cube: 1 is the whole range of a variable.
struct GssOptions {
  double initial_step = 0.1;
  double step_tolerance = 1e-3;
  /// 0.25 solves more than 0.5 of 795 moved, rotated and scaled problems, smooth, noisy and failing
  /// in part, to both tolerances at every budget from 10 to 100 (n + 1) evaluations:
  /// ./bench.sh more_wild_varied --contraction 0.5
  double contraction = 0.25;
  double sufficient_decrease = 0.01;  // alpha
  /// Points the method decides on before it knows the outcome of the first of them: part of the
  /// method, so that its trajectory does not depend on the workers. 1 needs the fewest evaluations,
  /// as many as there are workers the least time.
  int outstanding = 2;
};

class Gss : public Optimizer {
 public:
  /// Starts at the initial values of the space. Throws InputError for options out of range.
  explicit Gss(const DesignSpace& space, const GssOptions& options = {});
  ~Gss() override;

  std::vector<DesignPoint> propose(int count) const override;
  void observe(const DesignPoint& point, const Result<Score>& outcome) override;
  bool converged() const override;
  std::string ending() const override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace latsch
