// SPDX-License-Identifier: Apache-2.0
// Eigenpairs of K x = lambda M x, near ones made exact by a solver that is not.
//
// With X near eigenvectors, R = K X - M X Lambda what they leave, and D = P R with P near K^-1, the
// lowest Ritz vectors of the span of X and D replace X. The error of a vector falls by what P errs
// and by what of it the next eigenvectors bring back, that of an eigenvalue by the square: vectors
// found by a factor in single precision are exact after one or two steps, for one rough solution
// and two products a step. [Knyazev, Toward the optimal preconditioned eigensolver, SIAM J. Sci.
// Comput. 23 (2001) 517-541: without the third direction]
#pragma once

#include <Eigen/Core>
#include <functional>

#include "numerics/sparse/lanczos.h"
#include "numerics/sparse/symmetric_matrix.h"

namespace latsch::numerics {

/// The columns of X independent, near the lowest eigenvectors; a few more than are wanted make it
/// fast. `precondition`: X <- P X. Ends where all eigenvalues will change by less than `tolerance`
/// of themselves, as the last changes fell, or by rounding alone; converged says so.
EigenPairs<double> ritz_pairs(const SymmetricMatrix& K,
                              const SymmetricMatrix& M,
                              const std::function<void(Eigen::Ref<Eigen::MatrixXd>)>& precondition,
                              Eigen::MatrixXd X,
                              double tolerance);

}  // namespace latsch::numerics
