// SPDX-License-Identifier: Apache-2.0
// Generating-set search with a model step: direct search for target functions with kinks, valleys
// and points that fail, at some dozens of evaluations for a few variables.
//
// In the unit cube, let x be the best point, f its value, and d_i directions with steps D_i:
//
//   poll     evaluate x + D_i d_i, cut off at the bounds, the longest step first, and among equal
//            steps the direction nearest to the last success first. A point is better if
//            f(new) < f - alpha D_i^2  (sufficient decrease).
//   success  x moves to the better point. A new set of directions starts with the step that
//            succeeded, or with a longer one after several successes in a row.
//   failure  D_i is contracted. When all directions have failed at one length, the set is rotated.
//   search   after every outcome except that of a failed search step: evaluate the minimum, within
//            the length of the step, of a quadratic model fitted to the evaluated points nearest to
//            x. The same sufficient decrease is required.
//   end      when every direction has failed with a step below the tolerance.
//
// With linear constraints, the directions conform to the constraints within a step of x
// (conforming_set.h), steps are cut off at the constraints, points very near to constraints are
// moved onto them, and the model is minimized inside them (model_step.h). So every proposed point
// is feasible. [Lewis, Shepherd, Torczon, SIAM J. Sci. Comput. 29 (2007) 2507]
//
// The poll alone guarantees convergence, whatever the search step is [Kolda, Lewis, Torczon, SIAM
// Review 45 (2003) 385]. A step for each direction and the sufficient decrease with its factor are
// those of HOPSPACK 2.0 [Plantenga, SAND2009-6265]. Rotated directions and the model step are added
// because a target that is a sum of absolute residuals needs them. Such a sum grows from its
// minimum like a norm, so the model approximates f^2, which a quadratic fits on both sides of the
// kinks. If values are negative, the model approximates f.
//
// The search is asynchronous: `outstanding` points are being evaluated at any time, whatever the
// number of workers. Each point is chosen with the outcomes known at that time, and each outcome is
// processed in the order of the proposals, even if x has moved in the meantime. A Failure counts as
// infinite and is left out of the model. Points proposed ahead assume that the outstanding outcomes
// bring no success.
#pragma once

#include <memory>
#include <vector>

#include "optimization/problem/design_space.h"
#include "optimization/problem/optimizer.h"

namespace latsch {

/// Options of the search. Lengths are in the unit cube: 1 is the whole range of a variable.
struct GssOptions {
  double initial_step = 0.1;     // length of the first steps
  double step_tolerance = 1e-3;  // the search ends when no step longer than this improves
  /// Factor by which the step of a failed direction is shortened. A larger factor shortens the
  /// steps more slowly. 0.25 solves more than 0.5 of 795 test problems (shifted, rotated and
  /// scaled; smooth, noisy and partly failing), for both tolerances and for every budget from 10 to
  /// 100 (n + 1) evaluations: ./bench.sh more_wild_varied --contraction 0.5
  double contraction = 0.25;
  double sufficient_decrease = 0.01;  // alpha
  /// Number of points that the method proposes before it knows the outcome of the first of them. It
  /// is part of the method, so that the path does not depend on the number of workers. The value 1
  /// needs the fewest evaluations; a value equal to the number of workers needs the least time.
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
