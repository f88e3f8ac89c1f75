// SPDX-License-Identifier: Apache-2.0
#include "numerics/dense/dense_products.h"

#include <cassert>

#include "numerics/dense/blas_core.h"
#include "numerics/dense/blas_functions.h"

namespace latsch::numerics {
namespace {

template <class Matrix>
int stride(const Matrix& A) {
  return std::max(1, static_cast<int>(A.outerStride()));
}

}  // namespace

template <class Scalar>
DenseMatrix<Scalar> overlaps(const Eigen::Ref<const DenseMatrix<Scalar>>& A,
                             const Eigen::Ref<const DenseMatrix<Scalar>>& B) {
  assert(A.rows() == B.rows());
  const BlasTurn turn;
  DenseMatrix<Scalar> C(A.cols(), B.cols());
  const int m = static_cast<int>(A.cols()), n = static_cast<int>(B.cols()),
            k = static_cast<int>(A.rows());
  if (m == 0 || n == 0) return C;
  const int lda = stride(A), ldb = stride(B), ldc = stride(C);
  const Scalar one(1.0), zero(0.0);
  gemm(Scalar())(
      "C", "N", &m, &n, &k, &one, A.data(), &lda, B.data(), &ldb, &zero, C.data(), &ldc, 1, 1);
  return C;
}

template <class Scalar>
void add_product(Scalar alpha,
                 const Eigen::Ref<const DenseMatrix<Scalar>>& A,
                 const Eigen::Ref<const DenseMatrix<Scalar>>& B,
                 Scalar beta,
                 Eigen::Ref<DenseMatrix<Scalar>> C) {
  assert(A.cols() == B.rows() && C.rows() == A.rows() && C.cols() == B.cols());
  const BlasTurn turn;
  const int m = static_cast<int>(A.rows()), n = static_cast<int>(B.cols()),
            k = static_cast<int>(A.cols());
  if (m == 0 || n == 0) return;
  const int lda = stride(A), ldb = stride(B), ldc = stride(C);
  gemm(Scalar())(
      "N", "N", &m, &n, &k, &alpha, A.data(), &lda, B.data(), &ldb, &beta, C.data(), &ldc, 1, 1);
}

using Complex = std::complex<double>;
using RealRef = Eigen::Ref<const DenseMatrix<double>>;
using ComplexRef = Eigen::Ref<const DenseMatrix<Complex>>;
template DenseMatrix<double> overlaps<double>(const RealRef&, const RealRef&);
template DenseMatrix<Complex> overlaps<Complex>(const ComplexRef&, const ComplexRef&);
template void add_product<double>(
    double, const RealRef&, const RealRef&, double, Eigen::Ref<DenseMatrix<double>>);
template void add_product<Complex>(
    Complex, const ComplexRef&, const ComplexRef&, Complex, Eigen::Ref<DenseMatrix<Complex>>);

}  // namespace latsch::numerics
