// SPDX-License-Identifier: Apache-2.0
// A positive definite approximation B of the Hessian of a Lagrangian from its gradients: the BFGS
// update, damped so that B stays positive definite even if the curvature along the step is not
// [Powell 1978; Nocedal & Wright, Numerical Optimization, 2006, procedure 18.2].
#pragma once

#include <Eigen/Core>

namespace latsch {

/// s = u+ - u;  y is the gradient of L at u+ minus that at u, with the same multipliers. Before the
/// first update, B is replaced by  s'y / s's  times the unit matrix, because the initial size of B
/// is arbitrary.
Eigen::MatrixXd damped_bfgs(Eigen::MatrixXd B,
                            const Eigen::VectorXd& s,
                            const Eigen::VectorXd& y,
                            bool is_first);

}  // namespace latsch
