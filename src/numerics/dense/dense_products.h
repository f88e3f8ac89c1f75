// SPDX-License-Identifier: Apache-2.0
// Products of tall dense matrices by BLAS (gemm), which may use wider vectors than a portable build
// of Eigen.
#pragma once

#include <Eigen/Core>
#include <complex>

namespace latsch::numerics {

template <class Scalar>
using DenseMatrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

/// Returns A* B, the inner products of the columns of A with the columns of B.
template <class Scalar>
DenseMatrix<Scalar> overlaps(const Eigen::Ref<const DenseMatrix<Scalar>>& A,
                             const Eigen::Ref<const DenseMatrix<Scalar>>& B);

/// Computes C <- beta C + alpha A B.
template <class Scalar>
void add_product(Scalar alpha,
                 const Eigen::Ref<const DenseMatrix<Scalar>>& A,
                 const Eigen::Ref<const DenseMatrix<Scalar>>& B,
                 Scalar beta,
                 Eigen::Ref<DenseMatrix<Scalar>> C);

}  // namespace latsch::numerics
