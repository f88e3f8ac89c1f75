// SPDX-License-Identifier: Apache-2.0
// Minimizes |r_hat(z)|^2 + v(z), the expected value of a sum of squares, for lower <= z <= upper:
// the step of a trust region that is a box, inside bounds that are a box, too.
//
// It takes Levenberg's damped steps (levenberg_descent.h) in the free variables. A variable is held
// if it is at a bound and the slope pushes it outward. If a step would cross a bound, the variable
// is held there for the rest of this step. The result approaches a local minimum of the model and
// is never worse than z = 0.
#pragma once

#include <Eigen/Core>

#include "optimization/least_squares/residual_kriging.h"

namespace latsch {

Eigen::VectorXd minimize_in_box(const ResidualKriging& model,
                                const Eigen::VectorXd& lower,
                                const Eigen::VectorXd& upper);

}  // namespace latsch
