// SPDX-License-Identifier: Apache-2.0
// Directions of which the residuals feel nothing: v with  |J v| length <= 1e-6 |r|.
//
// Where a search ends with such directions, it knows nothing of what lies along them: an amplitude
// whose peak stands outside the data, a spring that carries no load. Moving there costs nothing of
// what was reached, so that is where a restart looks first.
#pragma once

#include <Eigen/Core>

namespace latsch {

/// Orthonormal columns, none where every direction is felt. `J`: dr/du; `length`: of a move in u;
/// `r`: norm of the residuals.
Eigen::MatrixXd flat_directions(const Eigen::MatrixXd& J, double length, double r);

/// Whether two vectors of residuals differ by as little.
bool is_same(const Eigen::VectorXd& r, const Eigen::VectorXd& other);

}  // namespace latsch
