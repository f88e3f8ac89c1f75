// SPDX-License-Identifier: Apache-2.0
// Eigenvalues of dense symmetric and Hermitian matrices of up to some hundred rows, by Eigen's
// tridiagonalization and implicit QR steps, compiled here once for all users. For sparse matrices
// see lanczos.h.
#pragma once

#include <Eigen/Core>

namespace latsch::numerics {

template <class Scalar>
struct SelfAdjointEigen {
  Eigen::VectorXd values;  // ascending
  /// Columns of length 1, in the order of the values.
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> vectors;
};

/// Computes A = V diag(values) V*. Only the lower triangle of A is read.
SelfAdjointEigen<double> self_adjoint_eigen(const Eigen::MatrixXd& A);
SelfAdjointEigen<std::complex<double>> self_adjoint_eigen(const Eigen::MatrixXcd& A);

/// Returns the eigenvalues, ascending, without the vectors.
Eigen::VectorXd self_adjoint_eigenvalues(const Eigen::MatrixXd& A);

/// Returns lambda of K x = lambda M x, ascending. M must be positive definite.
Eigen::VectorXd generalized_eigenvalues(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M);
Eigen::VectorXd generalized_eigenvalues(const Eigen::MatrixXcd& K, const Eigen::MatrixXcd& M);

}  // namespace latsch::numerics
