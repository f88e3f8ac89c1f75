// SPDX-License-Identifier: Apache-2.0
// Least |r_hat(z)|^2 + v(z), the value to be expected, among linear constraints:
//
//   lower <= z <= upper,   E z = 0,   A z <= b
//
// the step of a trust region (box_least_squares.h) where constraints cut it off. z = 0 has to
// fulfill them. Levenberg's damped steps from there (levenberg_descent.h), each a quadratic
// program:
//   least 1/2 p'(J'J + V + mu I) p + (J' r_hat + 1/2 grad v)'p   with z + p among the constraints
// Toward a local minimum of the model, never worse than z = 0.
#pragma once

#include <Eigen/Core>

#include "optimization/least_squares/residual_kriging.h"

namespace latsch {

Eigen::VectorXd minimize_in_polytope(const ResidualKriging& model,
                                     const Eigen::VectorXd& lower,
                                     const Eigen::VectorXd& upper,
                                     const Eigen::MatrixXd& E,
                                     const Eigen::MatrixXd& A,
                                     const Eigen::VectorXd& b);

}  // namespace latsch
