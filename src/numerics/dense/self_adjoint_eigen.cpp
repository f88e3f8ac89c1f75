// SPDX-License-Identifier: Apache-2.0
#include "numerics/dense/self_adjoint_eigen.h"

#include <Eigen/Eigenvalues>
#include <complex>

namespace latsch::numerics {
namespace {

template <class Matrix>
SelfAdjointEigen<typename Matrix::Scalar> pairs_of(const Matrix& A) {
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

template <class Matrix>
Eigen::VectorXd values_of(const Matrix& K, const Matrix& M) {
  return Eigen::GeneralizedSelfAdjointEigenSolver<Matrix>(K, M, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

}  // namespace

SelfAdjointEigen<double> self_adjoint_eigen(const Eigen::MatrixXd& A) { return pairs_of(A); }

SelfAdjointEigen<std::complex<double>> self_adjoint_eigen(const Eigen::MatrixXcd& A) {
  return pairs_of(A);
}

Eigen::VectorXd self_adjoint_eigenvalues(const Eigen::MatrixXd& A) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A, Eigen::EigenvaluesOnly).eigenvalues();
}

Eigen::VectorXd generalized_eigenvalues(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M) {
  return values_of(K, M);
}

Eigen::VectorXd generalized_eigenvalues(const Eigen::MatrixXcd& K, const Eigen::MatrixXcd& M) {
  return values_of(K, M);
}

}  // namespace latsch::numerics
