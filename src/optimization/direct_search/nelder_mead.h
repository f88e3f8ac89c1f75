// SPDX-License-Identifier: Apache-2.0
// Nelder and Mead's simplex inside bounds and linear constraints, for a handful of variables and
// targets without residuals, smooth or not. It is slow and has no proof of convergence, but it
// assumes nothing about the target.
//
// n + 1 vertices in the unit cube, from the best x_1 to the worst x_n+1; x_c is the centroid of all
// but the worst:
//   reflect   x_r = x_c + alpha (x_c - x_n+1)    accepted if f_1 <= f_r < f_n
//   expand    x_e = x_c + beta (x_r - x_c)       if f_r < f_1: the better of both is accepted
//   contract  x_k = x_c +- gamma (x_r - x_c)     outside if f_n <= f_r < f_n+1, else inside
//   shrink    x_i = x_1 + delta (x_i - x_1)      if the contraction fails, all vertices at once
// alpha = 1, beta = 1 + 2/n, gamma = 3/4 - 1/(2n), delta = 1 - 1/n for n > 1.
// [Nelder & Mead, Computer J. 7 (1965) 308]; factors [Gao & Han, Comput. Optim. Appl. 51 (2012)
// 259]. Points outside of bounds and linear constraints are replaced by the nearest point inside,
// which can flatten the simplex onto a constraint: the search may then end on the constraint away
// from its minimum. A Failure is worse than any value. The search ends when all vertices are within
// the tolerance of the best.
#pragma once

#include <memory>
#include <vector>

#include "optimization/problem/design_space.h"
#include "optimization/problem/optimizer.h"

namespace latsch {

/// Options of the search. Lengths are in the unit cube.
struct NelderMeadOptions {
  double initial_step = 0.1;     // distance from the start to every other vertex
  double step_tolerance = 1e-3;  // the search ends when all vertices are this close to the best
};

class NelderMead : public Optimizer {
 public:
  /// Starts at the initial values of the space. Throws InputError for options out of range.
  explicit NelderMead(const DesignSpace& space, const NelderMeadOptions& options = {});
  ~NelderMead() override;

  /// The start, a shrinkage and an expansion propose several points at once; all other steps
  /// propose one point at a time.
  std::vector<DesignPoint> propose(int count) const override;
  /// Observes an outcome. A point that the search did not propose does not become a vertex.
  void observe(const DesignPoint& point, const Result<Score>& outcome) override;
  bool converged() const override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace latsch
