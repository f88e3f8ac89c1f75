// SPDX-License-Identifier: Apache-2.0
// Variables that small residuals do not determine.
//
// A search ends if next to nothing of its residuals is left. That alone says nothing of a variable
// whose effect is as small: by the slopes J at this point, a variable u_i may be off by
//
//   d_i = |r| sqrt((M^-1)_ii),      M = J'J - C
//
// while the other variables follow it, before the residuals grow by their own size. C is the
// covariance of errors of the slopes, summed over the residuals: the slopes of a variable without
// effect, or of two variables that only their product determines, are not quite zero, because the
// curvature of others adds to them. A direction in which M is not positive counts as one without
// effect, and a variable may be off by its share of a move as long as the range of one variable.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "optimization/problem/design_space.h"

namespace latsch {

/// Slopes dr/du of the residuals at a point of the unit cube, and the covariance of their errors
/// between variables, n x n, summed over the residuals; zeros: exact.
struct PointSlopes {
  Eigen::MatrixXd J;
  Eigen::MatrixXd covariance;
};

/// Returns the names of the variables that may be off by more than 5 % of their value at u, a point
/// of the unit cube. `r` is the norm of the residuals there. Columns of J that are not finite count
/// as columns without effect.
std::vector<std::string> open_variables(const DesignSpace& space,
                                        const Eigen::VectorXd& u,
                                        const PointSlopes& slopes,
                                        double r);

}  // namespace latsch
