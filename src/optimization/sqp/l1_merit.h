// SPDX-License-Identifier: Apache-2.0
// The l1 merit function of a line search with constraints, and its slope along a step:
//
//   phi = f + sum mu_i max(c_i, 0) + sum mu_j |h_j|                                   (18.27)
//   D phi = g'd - (improvement of the linearized constraints along d)                 (18.29)
//
// Every mu stays above its multiplier, which makes phi exact and d a descent direction. After large
// multipliers mu decreases slowly [Powell 1978]. Equation numbers are those of [Nocedal & Wright,
// Numerical Optimization, 2006].
#pragma once

#include "optimization/sqp/smooth_values.h"
#include "optimization/sqp/sqp_step.h"

namespace latsch {

class L1Merit {
 public:
  void raise_above(const SqpStep& step);
  double operator()(const SmoothValues& values) const;
  double slope(const SmoothValues& values,
               const SmoothSlopes& slopes,
               const Eigen::VectorXd& d) const;

 private:
  double penalty(const Eigen::VectorXd& c, const Eigen::VectorXd& h) const;
  Eigen::VectorXd mu_, lambda_;  // penalty factors of c and of h
};

}  // namespace latsch
