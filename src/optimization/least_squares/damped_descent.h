// SPDX-License-Identifier: Apache-2.0
// Levenberg's and Marquardt's descent on the value that a model of residuals expects,
//
//   |r_hat(z)|^2 + v(z)      from z = 0, by steps p with
//   (J'J + V + mu I) p = -(J' r_hat + 1/2 grad v)
//
// mu up where p does not descend, down where it does; V the Hessian of v / 2. How p keeps within
// bounds or constraints is the caller's. A local minimum of the model, never worse than z = 0.
// [Nocedal & Wright, Numerical Optimization, 2006, ch. 10]
#pragma once

#include <Eigen/Core>
#include <functional>

#include "optimization/least_squares/residual_model.h"

namespace latsch {

/// The end z + p of the step with the matrix H, damped, and the slope g.
using DampedStep = std::function<Eigen::VectorXd(
    const Eigen::VectorXd& z, const Eigen::MatrixXd& H, const Eigen::VectorXd& g)>;

Eigen::VectorXd descend(const ResidualModel& model, Eigen::Index n, const DampedStep& step);

}  // namespace latsch
