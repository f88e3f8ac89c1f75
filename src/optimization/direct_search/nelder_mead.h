// SPDX-License-Identifier: Apache-2.0
// Nelder and Mead's simplex inside bounds and linear constraints: for a handful of variables and
// targets without residuals, smooth or not; slow, and without proof of convergence, but it assumes
// nothing.
//
// n + 1 vertices in the unit cube, best x_1 to worst x_n+1 with centroid x_c of all but the worst:
//   reflect   x_r = x_c + alpha (x_c - x_n+1)    taken where f_1 <= f_r < f_n
//   expand    x_e = x_c + beta (x_r - x_c)       where f_r < f_1: the better of both
//   contract  x_k = x_c +- gamma (x_r - x_c)     outside where f_n <= f_r < f_n+1, else inside
//   shrink    x_i = x_1 + delta (x_i - x_1)      where the contraction fails, all at once
// alpha = 1, beta = 1 + 2/n, gamma = 3/4 - 1/(2n), delta = 1 - 1/n for n > 1.
// [Nelder & Mead, Computer J. 7 (1965) 308]; factors [Gao & Han, Comput. Optim. Appl. 51 (2012)
// 259]. Points outside of bounds and linear constraints are replaced by the nearest inside, which
// can flatten the simplex onto a constraint: it may then end beside the minimum on it. A Failure is
// worse than any value. It ends when all vertices are within the tolerance of the best.
#pragma once

#include <memory>
#include <vector>

#include "optimization/problem/design_space.h"
#include "optimization/problem/optimizer.h"

namespace latsch {

/// Lengths are in the unit cube.
struct NelderMeadOptions {
  double initial_step = 0.1;  // from the start to every other vertex
  double step_tolerance = 1e-3;
};

class NelderMead : public Optimizer {
 public:
  /// Starts at the initial values of the space. Throws InputError for options out of range.
  explicit NelderMead(const DesignSpace& space, const NelderMeadOptions& options = {});
  ~NelderMead() override;

  /// The start, a shrinkage and an expansion are several points at once; the rest is one by one.
  std::vector<DesignPoint> propose(int count) const override;
  /// Points it did not ask for are none of its vertices.
  void observe(const DesignPoint& point, const Result<Score>& outcome) override;
  bool converged() const override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace latsch
