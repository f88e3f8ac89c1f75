// SPDX-License-Identifier: Apache-2.0
// Directions with no effect on the residuals: v with  |J v| length <= 1e-6 |r|.
//
// A search that ends with such directions knows nothing about points along them. Examples are the
// amplitude of a peak outside the range of the data, or the stiffness of a spring that carries no
// load. A move along such a direction does not make the result worse, so a restart first looks for
// better points there.
#pragma once

#include <Eigen/Core>

namespace latsch {

/// Returns orthonormal columns; none if every direction has an effect. `J` is dr/du, `length` is
/// the length of a move in u, and `r` is the norm of the residuals.
Eigen::MatrixXd flat_directions(const Eigen::MatrixXd& J, double length, double r);

/// True if two vectors of residuals differ by no more than 1e-6 of their norm.
bool is_same(const Eigen::VectorXd& r, const Eigen::VectorXd& other);

}  // namespace latsch
