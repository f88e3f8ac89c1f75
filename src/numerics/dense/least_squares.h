// SPDX-License-Identifier: Apache-2.0
// The least sum of squares of a smooth function of few unknowns: Levenberg-Marquardt as in MINPACK
// [Moré 1978], Eigen's translation of it, with derivatives by central differences. For functions
// that cost microseconds; what a simulation computes is fitted by src/optimization.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace latsch::numerics {

/// r(x); as many residuals as unknowns at least, always the same number.
using Residuals = std::function<Eigen::VectorXd(const Eigen::VectorXd& x)>;

struct LeastSquares {
  Eigen::VectorXd x;
  double sum = 0.0;            // |r|^2
  Eigen::MatrixXd covariance;  // of x: (J^T J)^-1 |r|^2 / (residuals - unknowns); 0 where there are
                               // no more residuals than unknowns, infinite where J has no full rank
  bool converged = false;
};

/// From `start`; unknowns should be of the order of 1.
LeastSquares least_squares(const Residuals& residuals, const Eigen::VectorXd& start);

}  // namespace latsch::numerics
