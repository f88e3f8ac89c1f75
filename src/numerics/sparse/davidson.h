// SPDX-License-Identifier: Apache-2.0
// Eigenpairs of K x = lambda M x, near ones brought nearer: Davidson's method with K^-1 before
// residuals.
//
// Of an approximate pair (lambda, x) the correction d = K^-1 (K x - lambda M x) is what one step of
// inverse iteration would change; |d| in the norm of M is the residual of the inverted problem, as
// LanczosSettings::tolerance. Corrections of all pairs that err more extend the space in which
// Rayleigh and Ritz find the pairs again, with K and M themselves. So corrections need not be
// exact: solutions by a factor in single precision do, and Lanczos' method with those, which finds
// eigenpairs of another K, is enough to begin with.
//   [Davidson 1975, J. Comput. Phys. 17, 87-94; Knyazev 2001, SIAM J. Sci. Comput. 23, 517-541]
#pragma once

#include <Eigen/Core>
#include <functional>

#include "numerics/sparse/lanczos.h"
#include "numerics/sparse/symmetric_matrix.h"

namespace latsch::numerics {

/// `vectors`: independent columns near the lowest eigenvectors; as many pairs come back. Some more
/// than are wanted make it fast. `solve`: X <- K^-1 X or nearly so. Converged where every |d| is
/// below the tolerance.
EigenPairs<double> davidson(const SymmetricMatrix& K,
                            const SymmetricMatrix& M,
                            const std::function<void(Eigen::Ref<Eigen::MatrixXd> X)>& solve,
                            const Eigen::MatrixXd& vectors,
                            double tolerance);

}  // namespace latsch::numerics
