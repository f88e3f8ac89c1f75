// SPDX-License-Identifier: Apache-2.0
// How residuals curve along a step, from two points at which they and their slopes are known:
//
//   c = 1/2 r''[p, p]      at u, by what is known at another point u_0
//
// With s = u - u_0 and p = a s + q, q across s, and T = r''(u):
//
//   T[s, s] = 6 (r_0 - r) + 4 J s + 2 J_0 s      the cubic through both ends               (1)
//   T[s, q] = (J - J_0) q                        a secant
//   c       = 1/2 a^2 T[s, s] + a T[s, q]        without T[q, q], which nobody knows       (2)
//
// (1) is exact for residuals cubic along s, (2) for quadratic ones up to the term it lacks: good
// for steps that go on along the way that led to u, or back.
#pragma once

#include <Eigen/Core>

namespace latsch {

/// Residuals and their slopes at a point.
struct Slopes {
  Eigen::VectorXd u;
  Eigen::VectorXd r;
  Eigen::MatrixXd J;  // dr/du
};

/// c of the step p from `at`. The points differ.
Eigen::VectorXd residual_curvature(const Slopes& at, const Slopes& other, const Eigen::VectorXd& p);

}  // namespace latsch
