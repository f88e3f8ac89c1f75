// SPDX-License-Identifier: Apache-2.0
// Least |r_hat(z)|^2 + v(z), the value to be expected, for lower <= z <= upper: the step of a trust
// region that is a box, inside bounds that are one too.
//
// A descent of Levenberg and Marquardt (damped_descent.h) on the free variables: a variable is held
// where the slope pushes it over a bound it is at, and at the bound that its part of a step would
// cross. A local minimum of the model, never worse than z = 0. [Nocedal & Wright, Numerical
// Optimization, 2006, ch. 16.7]
#pragma once

#include <Eigen/Core>

#include "optimization/least_squares/residual_model.h"

namespace latsch {

Eigen::VectorXd minimize_in_box(const ResidualModel& model,
                                const Eigen::VectorXd& lower,
                                const Eigen::VectorXd& upper);

}  // namespace latsch
