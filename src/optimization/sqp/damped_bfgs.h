// SPDX-License-Identifier: Apache-2.0
// A positive definite approximation B of the Hessian of a Lagrangian from its gradients: the BFGS
// update, damped so that B stays positive definite even if the curvature along the step is not
// [Powell 1978; Nocedal & Wright, Numerical Optimization, 2006, procedure 18.2].
#pragma once

#include <Eigen/Core>

namespace latsch {

/// Returns B updated by the step s = u+ - u and by y, the change of the gradient of the Lagrangian
/// L from u to u+ with the same multipliers. If `is_first` is true, B is replaced by  s'y / s's
/// times the unit matrix before the update, because the initial size of B is arbitrary.
Eigen::MatrixXd damped_bfgs(Eigen::MatrixXd B,
                            const Eigen::VectorXd& s,
                            const Eigen::VectorXd& y,
                            bool is_first);

}  // namespace latsch
