// SPDX-License-Identifier: Apache-2.0
// Minimizes |r_hat(z)|^2 + v(z), the expected value of a sum of squares, with linear constraints:
//
//   lower <= z <= upper,   E z = 0,   A z <= b
//
// This is the step of a trust region (box_least_squares.h) that is cut off by constraints. z = 0
// has to fulfill the constraints. From z = 0, Levenberg's damped steps (levenberg_descent.h) are
// taken, each as a quadratic program:
//   minimize 1/2 p'(J'J + V + mu I) p + (J' r_hat + 1/2 grad v)'p   with z + p feasible
// The result approaches a local minimum of the model and is never worse than z = 0.
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
