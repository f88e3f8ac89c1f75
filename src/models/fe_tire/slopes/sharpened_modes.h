// SPDX-License-Identifier: Apache-2.0
// Shapes of modes brought nearer to the solution: Davidson's method with K^-1 before residuals.
//
// Of an approximate mode (lambda, x) the correction d = K^-1 (K x - lambda M x) is what one step of
// inverse iteration would change; |d| in the norm of M is the residual of the inverted problem,
// SolverSettings::mode_tolerance. Corrections of all modes that err more than that extend the space
// in which Rayleigh and Ritz find the modes again. Corrections are small: their solutions need not
// be refined, where Lanczos' method needs every one of its own to the last digits.
//   [Davidson 1975, J. Comput. Phys. 17, 87-94; Knyazev 2001, SIAM J. Sci. Comput. 23, 517-541]
#pragma once

#include <Eigen/Core>

#include "base/result.h"
#include "numerics/sparse/factorization.h"
#include "numerics/sparse/symmetric_matrix.h"

namespace latsch::fe_tire {

/// `vectors`: M-orthonormal columns, the lowest first, near the lowest modes. Each comes back as
/// the mode of its place. `factor`: that of K.
Result<Eigen::MatrixXd> sharpened(const Eigen::MatrixXd& vectors,
                                  const numerics::SymmetricMatrix& K,
                                  const numerics::Factorization& factor,
                                  const numerics::SymmetricMatrix& M,
                                  double tolerance);

}  // namespace latsch::fe_tire
