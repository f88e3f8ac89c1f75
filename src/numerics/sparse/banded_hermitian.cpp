// SPDX-License-Identifier: Apache-2.0
#include "numerics/sparse/banded_hermitian.h"

#include <cassert>

#include "numerics/dense/blas_core.h"
#include "numerics/dense/self_adjoint_eigen.h"

extern "C" {
void zpbtrf_(const char* uplo,
             const int* n,
             const int* kd,
             std::complex<double>* ab,
             const int* ldab,
             int* info,
             std::size_t uplo_length);
void zpbtrs_(const char* uplo,
             const int* n,
             const int* kd,
             const int* nrhs,
             const std::complex<double>* ab,
             const int* ldab,
             std::complex<double>* b,
             const int* ldb,
             int* info,
             std::size_t uplo_length);
void zhbmv_(const char* uplo,
            const int* n,
            const int* k,
            const std::complex<double>* alpha,
            const std::complex<double>* a,
            const int* lda,
            const std::complex<double>* x,
            const int* incx,
            const std::complex<double>* beta,
            std::complex<double>* y,
            const int* incy,
            std::size_t uplo_length);
}

namespace latsch::numerics {

BandedHermitian::BandedHermitian(int size, int bandwidth)
    : lower_(Eigen::MatrixXcd::Zero(bandwidth + 1, size)) {}

void BandedHermitian::multiply(const Eigen::Ref<const Eigen::MatrixXcd>& X,
                               Eigen::Ref<Eigen::MatrixXcd> Y) const {
  const BlasTurn turn;
  const int n = size(), band = bandwidth(), leading = band + 1, stride = 1;
  const Complex one = 1.0, zero = 0.0;
  for (Eigen::Index k = 0; k < X.cols(); ++k) {
    zhbmv_("L",
           &n,
           &band,
           &one,
           lower_.data(),
           &leading,
           X.col(k).data(),
           &stride,
           &zero,
           Y.col(k).data(),
           &stride,
           1);
  }
}

bool BandedCholesky::factorize(const BandedHermitian& A) {
  const BlasTurn turn;
  factor_ = A.lower();
  const int n = A.size(), band = A.bandwidth(), leading = band + 1;
  int info = 0;
  zpbtrf_("L", &n, &band, factor_.data(), &leading, &info, 1);
  assert(info >= 0);
  return info == 0;
}

void BandedCholesky::solve(Eigen::Ref<Eigen::MatrixXcd> X) const {
  const BlasTurn turn;
  const int n = static_cast<int>(factor_.cols()), leading = static_cast<int>(factor_.rows());
  const int band = leading - 1, columns = static_cast<int>(X.cols()),
            stride = static_cast<int>(X.outerStride());
  assert(X.rows() == n);
  int info = 0;
  zpbtrs_("L", &n, &band, &columns, factor_.data(), &leading, X.data(), &stride, &info, 1);
  assert(info == 0);
}

void BorderedHermitian::add(double factor, const BorderedHermitian& other) {
  banded.lower() += factor * other.banded.lower();
  border += factor * other.border;
  corner += factor * other.corner;
}

void BorderedHermitian::multiply(const Eigen::Ref<const Eigen::MatrixXcd>& X,
                                 Eigen::Ref<Eigen::MatrixXcd> Y) const {
  const Eigen::Index m = banded.size(), b = corner.rows();
  banded.multiply(X.topRows(m), Y.topRows(m));
  if (b == 0) return;
  Y.topRows(m).noalias() += border * X.bottomRows(b);
  Y.bottomRows(b).noalias() = border.adjoint() * X.topRows(m);
  Y.bottomRows(b).noalias() += corner * X.bottomRows(b);
}

bool BorderedCholesky::factorize(const BorderedHermitian& A) {
  if (!banded_.factorize(A.banded)) return false;
  border_ = A.border;
  solved_ = A.border;
  if (A.corner.rows() == 0) return true;
  banded_.solve(solved_);
  const auto schur = self_adjoint_eigen(Eigen::MatrixXcd(A.corner - border_.adjoint() * solved_));
  if (!(schur.values.minCoeff() > 0.0)) return false;
  inverse_ = schur.vectors * schur.values.cwiseInverse().cast<std::complex<double>>().asDiagonal() *
             schur.vectors.adjoint();
  return true;
}

void BorderedCholesky::solve(Eigen::Ref<Eigen::MatrixXcd> X) const {
  const Eigen::Index m = border_.rows(), b = border_.cols();
  banded_.solve(X.topRows(m));
  if (b == 0) return;
  X.bottomRows(b) = (inverse_ * (X.bottomRows(b) - border_.adjoint() * X.topRows(m))).eval();
  X.topRows(m).noalias() -= solved_ * X.bottomRows(b);
}

}  // namespace latsch::numerics
