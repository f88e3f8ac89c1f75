// SPDX-License-Identifier: Apache-2.0
// Levenberg-Marquardt: least sum of squares,  f(u) = |r(u)|^2,  from residuals and their exact
// Jacobian, in the trust region of Moré [in: Numerical Analysis, Lecture Notes in Mathematics 630,
// Springer 1978, 105] with the numbers of MINPACK's lmder, inside bounds and linear constraints.
//
// In the unit cube, at the best point u:
//
//   step      least |r + J p|^2 with |p| <= Delta and u + p in the region:
//             levenberg_marquardt_step.h. The cube is the scale: where Moré's D are norms of the
//             columns of J, variables that are hardly felt go far, out of what the slopes are good
//             for [Transtrum & Sethna, arXiv:1201.5885 (2012)].
//   gain      (f(u) - f(u + p)) / (|r|^2 - |r + J p|^2)
//             A step with a gain above 0.0001 is taken.
//   radius    a gain below 1/4 shortens Delta to the least value of the parabola through f(u), its
//             slope and f(u + p), 1/10 to 1/2 of it; one above 3/4, or of a full step, makes it
//             twice |p|.
//   bend      Where residuals and slopes at another point along the way are known, so is how the
//             residuals curve along p (residual_curvature.h): p becomes the damped step, of the
//             same mu, from r and that curvature. It is Transtrum's and Sethna's geodesic
//             acceleration without an evaluation for it, up to the turn that they allow.
//   return    In a narrow bent valley a step along its floor ends high on its side, where J is
//             known as well: a few steps from there, each as long as the first at most, lead to
//             the residuals that the linear model had at the end of p: back to the floor, across
//             the valley, and no further along it. Where they end counts as u + p, with a
//             radius of 4 or 10 |p| on success. A watchdog's way [Chamberlain, Powell, Lemaréchal
//             & Pedersen, Math. Program. Study 16 (1982) 1]; only where the step before has left
//             f above a tenth of what it was, and as long as the slopes there promise an end
//             below f(u) by a tenth of what p had promised.
//   end       where the linear model promises less than gain_tolerance of f, or its full step is
//             shorter than the tolerance; where steps in the radius are; where steps gain too
//             little. Asked before a step is evaluated.
//
// A variable is held at a bound where the slope pushes it over, and for the rest of a step at the
// bound that the step would cross: a projected step, where Moré has no bounds. Among linear
// constraints every step is a quadratic program. A Failure, a number that is not finite, residuals
// too few or too many: each shortens Delta to a quarter of the step. A start that fails is moved
// toward the middle of the region.
//
// One point at a time: idle workers get the shorter steps that follow failures, once there have
// been some. A point of others is taken over, where it is better, when an own one comes in; for
// that it needs its Jacobian.
//
// Convergence is quadratic where the residuals vanish at the end, else linear, the faster the less
// they and their curvature are. It ends in the minimum downhill of its start. No derivatives, or
// noise: residual_trust_region.h; nonlinear constraints: sqp.h.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "optimization/problem/design_space.h"
#include "optimization/problem/optimizer.h"

namespace latsch {

/// Lengths are in the unit cube: 1 is the whole range of a variable.
struct LevenbergMarquardtOptions {
  /// First Delta: |p| of a move of all variables by so much. The slopes are exact: it may be wide.
  double initial_step = 0.5;
  double step_tolerance = 1e-6;
  /// What the full step of the linear model has to promise, of f.
  double gain_tolerance = 1e-10;
  /// What three steps that are taken have to gain together, of f, where the full step of the linear
  /// model promises less than half of it: the way along a bent valley or a kink may be long. 0:
  /// anything, or what a study's noise says [optimizer_choice.cpp].
  double progress_tolerance = 0.0;
  /// Steps back to the floor of a valley, of one step that led up its side; 0: none.
  int most_returns = 6;
};

class LevenbergMarquardt : public Optimizer {
 public:
  /// Starts at the initial values of the space. Throws InputError for options out of range.
  explicit LevenbergMarquardt(const DesignSpace& space,
                              const LevenbergMarquardtOptions& options = {});
  ~LevenbergMarquardt() override;

  std::vector<DesignPoint> propose(int count) const override;
  /// Throws InputError for a score without residuals or, of a point it asked for, without Jacobian.
  void observe(const DesignPoint& point, const Result<Score>& outcome) override;
  bool converged() const override;
  std::string ending() const override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace latsch
