// SPDX-License-Identifier: Apache-2.0
// Levenberg-Marquardt minimizes a sum of squares,  f(u) = |r(u)|^2,  from residuals and their exact
// Jacobian. It uses the trust region of Moré [in: Numerical Analysis, Lecture Notes in Mathematics
// 630, Springer 1978, 105] with the constants of MINPACK's lmder, inside bounds and linear
// constraints.
//
// In the unit cube, at the best point u:
//
//   step      minimizes |r + J p|^2 with |p| <= Delta and u + p in the region:
//             levenberg_marquardt_step.h. The unit cube is the scale. Moré's scales D are norms of
//             the columns of J, so variables with little effect would move far, beyond the validity
//             of the slopes [Transtrum & Sethna, arXiv:1201.5885 (2012)].
//   gain      (f(u) - f(u + p)) / (|r|^2 - |r + J p|^2)
//             A step with a gain above 0.0001 is accepted.
//   radius    A gain below 1/4 shortens Delta to the minimum of the parabola through f(u), its
//             slope and f(u + p), within 1/10 to 1/2 of Delta. If the gain is above 3/4, or if the
//             step was a full one, Delta becomes twice |p|.
//   bend      If residuals and slopes at another point on the path are known, so is the curvature
//             of the residuals along p (residual_curvature.h): p becomes the damped step, with the
//             same mu, from r and that curvature. This is Transtrum's and Sethna's geodesic
//             acceleration without an additional evaluation, limited to the correction they allow.
//   return    In a narrow curved valley a step along its floor ends high on its side, where J is
//             known as well. A few steps from there, each at most as long as the first, lead to the
//             residuals that the linear model had at the end of p: back to the floor, across the
//             valley, and no further along it. Their end counts as u + p; on success the radius
//             becomes 4 or 10 |p|. This is a watchdog method [Chamberlain, Powell, Lemaréchal &
//             Pedersen, Math. Program. Study 16 (1982) 1]. It is used only if the step before has
//             left f above a tenth of its value, and as long as the slopes on the side predict a
//             decrease below f(u) by at least a tenth of the decrease that p predicted.
//   end       The search ends if the linear model predicts a decrease of less than gain_tolerance
//             times f, if its full step or the steps in the radius are shorter than the tolerance,
//             or if steps gain too little. This is checked before a step is evaluated.
//
// A variable is held if it is at a bound and the slope pushes it outward. If a step would cross a
// bound, the variable is held there for the rest of this step: a projected step; Moré's method has
// no bounds. With linear constraints every step is a quadratic program. A Failure, a number that is
// not finite, or a wrong number of residuals shortens Delta to a quarter of the step. A start that
// fails is moved toward the middle of the region.
//
// The method needs one point at a time. Once there have been some failures, idle workers evaluate
// the shorter steps that would follow further failures. If a better point from another source is
// observed, it is adopted together with the next point of the method; it must have a Jacobian.
//
// Convergence is quadratic if the residuals vanish at the end, otherwise linear, and faster if
// residuals and their curvature are small. The search ends in the local minimum downhill of its
// start. Without derivatives, or with noise, use residual_trust_region.h; for nonlinear
// constraints, sqp.h.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "optimization/problem/design_space.h"
#include "optimization/problem/optimizer.h"

namespace latsch {

/// Options of the search. Lengths are in the unit cube: 1 is the whole range of a variable.
struct LevenbergMarquardtOptions {
  /// First radius Delta: the length of a step p in which all variables move by this value. It may
  /// be large, because the slopes are exact.
  double initial_step = 0.5;
  /// The search ends if the next step is shorter than this length.
  double step_tolerance = 1e-6;
  /// The search ends if the linear model predicts a gain of less than this share of f for the full
  /// step.
  double gain_tolerance = 1e-10;
  /// The search ends if three accepted steps together decrease f by less than this share of f and
  /// the linear model predicts less than half of that for the full step: the path along a curved
  /// valley or a kink may be long. The value 0 accepts any decrease; a study may set it from its
  /// noise [optimizer_choice.cpp].
  double progress_tolerance = 0.0;
  /// Largest number of steps back to the floor of a valley after a step that ended on its side; 0:
  /// none.
  int most_returns = 6;
};

class LevenbergMarquardt : public Optimizer {
 public:
  /// Starts at the initial values of the space. Throws InputError for options out of range.
  explicit LevenbergMarquardt(const DesignSpace& space,
                              const LevenbergMarquardtOptions& options = {});
  ~LevenbergMarquardt() override;

  std::vector<DesignPoint> propose(int count) const override;
  /// Throws InputError for a score without residuals, or without Jacobian if the optimizer proposed
  /// the point.
  void observe(const DesignPoint& point, const Result<Score>& outcome) override;
  bool converged() const override;
  std::string ending() const override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace latsch
