// SPDX-License-Identifier: Apache-2.0
// Minimizes the sum of squares of a smooth function of few unknowns by Levenberg-Marquardt as in
// MINPACK [Moré 1978], in Eigen's translation, with derivatives by central differences. It is meant
// for functions that take microseconds; results of simulations are fitted by src/optimization.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace latsch::numerics {

/// Returns r(x), always of the same size, with at least as many residuals as unknowns.
using Residuals = std::function<Eigen::VectorXd(const Eigen::VectorXd& x)>;

struct LeastSquares {
  Eigen::VectorXd x;
  double sum = 0.0;  // |r|^2
  /// Covariance of x, (J^T J)^-1 |r|^2 / (residuals - unknowns). It is 0 if there are no more
  /// residuals than unknowns, and infinite if J does not have full rank.
  Eigen::MatrixXd covariance;
  bool converged = false;
};

/// Starts from `start`. Unknowns should be of the order of 1.
LeastSquares least_squares(const Residuals& residuals, const Eigen::VectorXd& start);

}  // namespace latsch::numerics
