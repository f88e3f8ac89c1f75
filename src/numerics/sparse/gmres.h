// SPDX-License-Identifier: Apache-2.0
// Generalized minimal residuals without restart for A x = b with unsymmetric A and a preconditioner
// C near A. [Saad, Iterative Methods for Sparse Linear Systems, 2nd ed., SIAM 2003, algorithm 9.5:
// right preconditioning, so that the residual itself is minimized]
#pragma once

#include "numerics/sparse/conjugate_gradients.h"

namespace latsch::numerics {

/// Starts from x = 0 and stops at |b - A x| <= tolerance |b|, or with the least residual after
/// `max_iterations` products with A.
CgOutcome gmres(const ConjugateGradients::Operator& A,
                const ConjugateGradients::Preconditioner& C,
                const Eigen::VectorXd& b,
                double tolerance,
                int max_iterations,
                Eigen::VectorXd& x);

}  // namespace latsch::numerics
