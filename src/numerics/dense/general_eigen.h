// SPDX-License-Identifier: Apache-2.0
// Eigenvalues of dense unsymmetric real matrices of up to some hundred rows, by Eigen's Hessenberg
// form and Francis' QR steps, compiled here once for all users.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>

namespace latsch::numerics {

struct GeneralEigen {
  Eigen::VectorXcd values;   // not sorted; the two of a conjugate pair are adjacent
  Eigen::MatrixXcd vectors;  // columns of length 1, in the order of the values
};

/// Computes A V = V diag(values). Returns nothing if the steps do not converge, as with values that
/// are not numbers.
std::optional<GeneralEigen> general_eigen(const Eigen::MatrixXd& A);

}  // namespace latsch::numerics
