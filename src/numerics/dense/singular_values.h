// SPDX-License-Identifier: Apache-2.0
// Singular values of dense matrices with few columns by one-sided Jacobi rotations, which find
// small values to high relative accuracy; from Eigen, compiled here once for all users.
#pragma once

#include <Eigen/Core>

namespace latsch::numerics {

/// Decomposition J = U diag(values) V' of an m x n matrix, without U.
struct SingularValues {
  Eigen::VectorXd values;  // min(m, n) values, descending
  Eigen::MatrixXd V;       // n x n; J V_k = 0 for every column k >= values.size()
};

SingularValues singular_values(const Eigen::MatrixXd& J);

}  // namespace latsch::numerics
