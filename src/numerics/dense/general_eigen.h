// SPDX-License-Identifier: Apache-2.0
// Eigenvalues of dense real matrices without symmetry, of up to some hundred rows: Eigen's
// Hessenberg form and Francis' QR steps, compiled here once for all who ask.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>

namespace latsch::numerics {

struct GeneralEigen {
  Eigen::VectorXcd values;   // in no order; those of a pair one after the other
  Eigen::MatrixXcd vectors;  // columns of length 1, in order
};

/// A V = V diag(values). Nothing where the steps do not end, which numbers that are none bring
/// about.
std::optional<GeneralEigen> general_eigen(const Eigen::MatrixXd& A);

}  // namespace latsch::numerics
