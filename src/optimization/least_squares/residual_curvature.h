// SPDX-License-Identifier: Apache-2.0
// Estimates the curvature of residuals along a step from two points with known residuals and
// slopes:
//
//   c = 1/2 r''[p, p]      at u, from the values at another point u_0
//
// With s = u - u_0, p = a s + q with q perpendicular to s, and T = r''(u):
//
//   T[s, s] = 6 (r_0 - r) + 4 J s + 2 J_0 s      of the cubic through both points          (1)
//   T[s, q] = (J - J_0) q                        by a secant of the slopes
//   c       = 1/2 a^2 T[s, s] + a T[s, q]        without the unknown T[q, q]                (2)
//
// (1) is exact if the residuals are cubic along s; (2) is exact, apart from the missing term, if
// they are quadratic. The estimate suits steps that continue the path that led to u, or go back
// along it.
#pragma once

#include <Eigen/Core>

namespace latsch {

/// Residuals and their slopes at a point.
struct Slopes {
  Eigen::VectorXd u;
  Eigen::VectorXd r;
  Eigen::MatrixXd J;  // dr/du
};

/// Returns the curvature term c of the step p from `at`. The two points must differ.
Eigen::VectorXd residual_curvature(const Slopes& at, const Slopes& other, const Eigen::VectorXd& p);

}  // namespace latsch
