// SPDX-License-Identifier: Apache-2.0
// Least |r_hat(z)|^2 + v(z), the value to be expected, for lower <= z <= upper: the step of a trust
// region that is a box, inside bounds that are one too.
//
// Levenberg's and Marquardt's method on the free variables, from z = 0:
//   (J'J + V + mu I) p = -(J' r_hat + 1/2 grad v),   mu up where p does not descend, down where it
//   does; V the Hessian of v / 2
// A variable is held where the slope pushes it over a bound it is at, and at the bound that its
// part of p would cross. A local minimum of the model, never worse than z = 0. [Nocedal & Wright,
// Numerical Optimization, 2006, ch. 10 and 16.7]
#pragma once

#include <Eigen/Core>

#include "optimization/residual_model.h"

namespace latsch {

Eigen::VectorXd minimize_in_box(const ResidualModel& model,
                                const Eigen::VectorXd& lower,
                                const Eigen::VectorXd& upper);

}  // namespace latsch
