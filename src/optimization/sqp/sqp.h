// SPDX-License-Identifier: Apache-2.0
// Sequential quadratic programming for smooth targets with bounds, linear and nonlinear
// constraints. It needs the fewest evaluations if all functions are smooth and no evaluation fails.
//
// At the point x, with slopes from differences or from the model itself:
//
//   step      d and multipliers from a quadratic program: sqp_step.h. Its B is 2 J'J if f is
//             |r|^2 with known residuals (Gauss-Newton), otherwise the damped BFGS approximation of
//             the Hessian of the Lagrangian: damped_bfgs.h.
//   merit     phi(x) = f + sum mu_i max(c_i, 0) + sum mu_j |h_j|,  mu above the multipliers (18.27)
//   search    x + a d for a = 1, 1/2, 1/4 ... until  phi(x + a d) <= phi(x) + eta a D phi (18.28).
//             If a full step fails because constraints are curved, a second-order correction
//             (ch. 15.6) is tried once. A Failure shortens the step to a quarter.
//   end       if a step is shorter than the tolerance, or no step along d brings an improvement.
//
// [Nocedal & Wright, Numerical Optimization, 2006, ch. 18]. Every point fulfills bounds and linear
// constraints, including the points of differences. If the evaluation of a difference fails, it is
// tried in the other direction and shorter; if all attempts fail, the slope counts as 0. A start
// that fails is moved toward the middle of the region.
//
// The differences at x are independent of each other, so as many workers as variables are busy.
// While a step is evaluated, idle workers evaluate the differences at its end and the next shorter
// step. When a step is complete, the best of the points from other sources is adopted if it is
// better. Limits: kinks and noise (gss.h, residual_trust_region.h).
#pragma once

#include <memory>
#include <vector>

#include "optimization/problem/design_space.h"
#include "optimization/problem/optimizer.h"

namespace latsch {

/// Options of the search. Lengths are in the unit cube: 1 is the whole range of a variable.
struct SqpOptions {
  double initial_step = 0.1;     // longest first step
  double step_tolerance = 1e-3;  // the search ends when no step longer than this improves
  double difference = 1e-4;      // at least the square root of the functions' relative noise
};

class Sqp : public Optimizer {
 public:
  /// Starts at the initial values of the space. Throws InputError for options out of range.
  explicit Sqp(const DesignSpace& space, const SqpOptions& options = {});
  ~Sqp() override;

  std::vector<DesignPoint> propose(int count) const override;
  void observe(const DesignPoint& point, const Result<Score>& outcome) override;
  bool converged() const override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace latsch
