// SPDX-License-Identifier: Apache-2.0
// Modes of a system with gyroscopic forces: (K + omega G - omega^2 M) phi = 0 with Hermitian K, G
// and M, K and M positive definite. A wave around a spinning body has such modes.
//
// With z = (phi, omega phi) the problem is linear, B z = (1 / omega) A z with
//   A = diag(K, M),   B = [-G M; M 0].
// A is positive definite, so every omega is real and half of them are positive. A^-1 B is
// self-adjoint in the inner product of A, and Lanczos' method finds its largest and smallest
// eigenvalues, which are the lowest omega of either sign.
// [Tisseur & Meerbergen, The quadratic eigenvalue problem, SIAM Review 43 (2001) 235-286]
#pragma once

#include <Eigen/Core>

#include "numerics/sparse/banded_hermitian.h"

namespace latsch::numerics {

/// The matrices; all have the same size, bandwidth and border.
struct GyroscopicProblem {
  BorderedHermitian K, G, M;
};

struct GyroscopicModes {
  Eigen::VectorXd omega;  // rad/s, ascending magnitude, all of the requested sign
  Eigen::MatrixXcd phi;   // columns with phi* K phi + omega^2 phi* M phi = 1
  bool converged = false;
  int solves = 0;
};

/// Finds the `count` omega of least magnitude that are positive (sign = 1) or negative (sign = -1).
/// `K_factor` factorizes K. `tolerance` is that of LanczosSettings.
GyroscopicModes gyroscopic_modes(const GyroscopicProblem& problem,
                                 const BorderedCholesky& K_factor,
                                 int sign,
                                 int count,
                                 double tolerance);

/// True if no omega lies between 0 and `omega` (of either sign): K + omega G - omega^2 M is then
/// positive definite, and only then.
bool no_mode_below(const GyroscopicProblem& problem, double omega);

}  // namespace latsch::numerics
