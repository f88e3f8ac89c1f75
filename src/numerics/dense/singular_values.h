// SPDX-License-Identifier: Apache-2.0
// Singular values of dense matrices with few columns: one-sided Jacobi rotations, which find small
// ones to high relative accuracy; Eigen's, compiled here once for all who ask.
#pragma once

#include <Eigen/Core>

namespace latsch::numerics {

/// J = U diag(values) V' of an m x n matrix, without U.
struct SingularValues {
  Eigen::VectorXd values;  // min(m, n) of them, descending
  Eigen::MatrixXd V;       // n x n; columns beyond the values are not felt at all
};

SingularValues singular_values(const Eigen::MatrixXd& J);

}  // namespace latsch::numerics
