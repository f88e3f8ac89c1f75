// SPDX-License-Identifier: Apache-2.0
// Products of tall dense matrices by BLAS (gemm), which uses wider vectors than a portable build of
// Eigen may.
#pragma once

#include <Eigen/Core>
#include <complex>

namespace latsch::numerics {

template <class Scalar>
using DenseMatrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

/// C = A* B, the overlaps of the columns.
template <class Scalar>
DenseMatrix<Scalar> overlaps(const Eigen::Ref<const DenseMatrix<Scalar>>& A,
                             const Eigen::Ref<const DenseMatrix<Scalar>>& B);

/// C <- beta C + alpha A B.
template <class Scalar>
void add_product(Scalar alpha,
                 const Eigen::Ref<const DenseMatrix<Scalar>>& A,
                 const Eigen::Ref<const DenseMatrix<Scalar>>& B,
                 Scalar beta,
                 Eigen::Ref<DenseMatrix<Scalar>> C);

}  // namespace latsch::numerics
