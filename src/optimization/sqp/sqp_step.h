// SPDX-License-Identifier: Apache-2.0
// The step of sequential quadratic programming solves the quadratic program at a point,
//
//   minimize 1/2 d'B d + g'd   with   c + J_c d <= 0,  h + J_h d = 0,                 (18.11)
//                                     u + d in the region,  |d_i| <= longest
//
// If the linearized constraints contradict each other or the region, they are relaxed by one small
// t >= 0:  c + J_c d <= t,  |h + J_h d| <= t. [Nocedal & Wright, Numerical Optimization, 2006, ch.
// 18.1 and 18.5]
#pragma once

#include "optimization/problem/feasible_region.h"
#include "optimization/sqp/smooth_values.h"

namespace latsch {

struct SqpStep {
  Eigen::VectorXd d;
  Eigen::VectorXd mu, lambda;  // multipliers of c and h
};

/// Solves the program. `values` contains c and h: those at u, or those at the end of a step for its
/// second-order correction.
SqpStep sqp_step(const Eigen::MatrixXd& B,
                 const SmoothValues& values,
                 const SmoothSlopes& slopes,
                 const FeasibleRegion& region,
                 const Eigen::VectorXd& u,
                 double longest);

}  // namespace latsch
