// SPDX-License-Identifier: Apache-2.0
// Shapes in which a tire responds: modes, and static displacements under loads, in one numbering of
// the ring's unknowns.
#pragma once

#include <Eigen/Core>

#include "base/result.h"
#include "numerics/sparse/factorization.h"
#include "numerics/sparse/symmetric_matrix.h"

namespace latsch::fe_tire {

/// Returns the modes of K x = omega^2 M x up to the frequency `limit`, Hz, and at least one, as
/// columns of unit mass. They are approximate, because they only span a space. `factor` is that of
/// K. A Failure says that Lanczos' method did not find them.
Result<Eigen::MatrixXd> modes_up_to(double limit,
                                    const numerics::Factorization& factor,
                                    const numerics::SymmetricMatrix& M);

/// Appends vectors to the columns of `basis`, which are orthogonal and of unit mass, so that they
/// stay so. Vectors that the basis already contains are left out.
void append_orthogonal(const Eigen::MatrixXd& vectors,
                       const numerics::SymmetricMatrix& M,
                       Eigen::MatrixXd& basis);

}  // namespace latsch::fe_tire
