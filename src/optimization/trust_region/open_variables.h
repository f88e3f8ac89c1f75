// SPDX-License-Identifier: Apache-2.0
// Variables that small residuals do not determine.
//
// A search ends if next to nothing of its residuals is left. That alone says nothing of a variable
// whose effect is as small: by the slopes J at this point, a variable u_i may be off by
//
//   d_i = |r| / |part of column i of J that is orthogonal to the other columns|
//
// while the other variables follow it, before the residuals grow by their own size.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "optimization/problem/design_space.h"

namespace latsch {

/// Returns the names of the variables that may be off by more than 5 % of their value at u, a point
/// of the unit cube. `J` is dr/du there, and `r` is the norm of the residuals. Columns of J that
/// are not finite count as columns without effect.
std::vector<std::string> open_variables(const DesignSpace& space,
                                        const Eigen::VectorXd& u,
                                        const Eigen::MatrixXd& J,
                                        double r);

}  // namespace latsch
