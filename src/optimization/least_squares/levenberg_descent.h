// SPDX-License-Identifier: Apache-2.0
// Descent by Levenberg's damped steps on the expected value of a model of residuals,
//
//   |r_hat(z)|^2 + v(z)      from z = 0, by steps p with
//   (J'J + V + mu I) p = -(J' r_hat + 1/2 grad v)
//
// V is the positive semidefinite part of the Hessian of v / 2. mu is a multiple of the largest
// diagonal entry. It grows tenfold if p does not descend and falls to a hundredth if it does. Any
// descent is accepted without a gain ratio, because evaluating the model costs almost nothing. The
// caller restricts p to bounds or constraints. The result approaches a local minimum of the model
// and is never worse than z = 0. [Levenberg, Q. Appl. Math. 2 (1944) 164]
#pragma once

#include <Eigen/Core>
#include <functional>

#include "optimization/least_squares/residual_kriging.h"

namespace latsch {

/// Returns the end z + p of a step, given the damped matrix H and the gradient g.
using DampedStep = std::function<Eigen::VectorXd(
    const Eigen::VectorXd& z, const Eigen::MatrixXd& H, const Eigen::VectorXd& g)>;

Eigen::VectorXd levenberg_descent(const ResidualKriging& model,
                                  Eigen::Index n,
                                  const DampedStep& step);

}  // namespace latsch
