// SPDX-License-Identifier: Apache-2.0
// Descent by Levenberg's damped steps on the value that a model of residuals expects,
//
//   |r_hat(z)|^2 + v(z)      from z = 0, by steps p with
//   (J'J + V + mu I) p = -(J' r_hat + 1/2 grad v)
//
// V the part of the Hessian of v / 2 that is never negative. mu is a share of the largest diagonal
// entry, ten times larger where p does not descend, a hundred times smaller where it does: any
// descent is taken, no gain ratio is asked for, as a value of the model costs next to nothing. How
// p keeps within bounds or constraints is the caller's. Toward a local minimum of the model, never
// worse than z = 0. [Levenberg, Q. Appl. Math. 2 (1944) 164]
#pragma once

#include <Eigen/Core>
#include <functional>

#include "optimization/least_squares/residual_kriging.h"

namespace latsch {

/// The end z + p of the step with the matrix H, which is damped, and the slope g.
using DampedStep = std::function<Eigen::VectorXd(
    const Eigen::VectorXd& z, const Eigen::MatrixXd& H, const Eigen::VectorXd& g)>;

Eigen::VectorXd levenberg_descent(const ResidualKriging& model,
                                  Eigen::Index n,
                                  const DampedStep& step);

}  // namespace latsch
