// SPDX-License-Identifier: Apache-2.0
// Functions of BLAS and LAPACK that are called in several precisions, as Fortran declares them:
// every argument by address, lengths of texts last. gemm(Real()) is the function for Real. Callers
// must hold a BlasTurn (blas_core.h).
#pragma once

#include <complex>
#include <cstddef>

namespace latsch::numerics::blas {

using Text = const char*;
using Int = const int*;
using Length = std::size_t;
template <class Real>
using Potrf = void(Text, Int, Real*, Int, int*, Length);
template <class Real>
using Getrf = void(Int, Int, Real*, Int, int*, int*);
template <class Real>
using Getrs = void(Text, Int, Int, const Real*, Int, Int, Real*, Int, int*, Length);
template <class Real>
using Trsm = void(Text,
                  Text,
                  Text,
                  Text,
                  Int,
                  Int,
                  const Real*,
                  const Real*,
                  Int,
                  Real*,
                  Int,
                  Length,
                  Length,
                  Length,
                  Length);
template <class Real>
using Syrk = void(
    Text, Text, Int, Int, const Real*, const Real*, Int, const Real*, Real*, Int, Length, Length);
template <class Real>
using Gemm = void(Text,
                  Text,
                  Int,
                  Int,
                  Int,
                  const Real*,
                  const Real*,
                  Int,
                  const Real*,
                  Int,
                  const Real*,
                  Real*,
                  Int,
                  Length,
                  Length);
template <class Real>
using Trsv = void(Text, Text, Text, Int, const Real*, Int, Real*, Int, Length, Length, Length);
template <class Real>
using Gemv = void(Text,
                  Int,
                  Int,
                  const Real*,
                  const Real*,
                  Int,
                  const Real*,
                  Int,
                  const Real*,
                  Real*,
                  Int,
                  Length);

}  // namespace latsch::numerics::blas

extern "C" {
latsch::numerics::blas::Potrf<float> spotrf_;
latsch::numerics::blas::Potrf<double> dpotrf_;
latsch::numerics::blas::Getrf<float> sgetrf_;
latsch::numerics::blas::Getrs<float> sgetrs_;
latsch::numerics::blas::Trsm<float> strsm_;
latsch::numerics::blas::Trsm<double> dtrsm_;
latsch::numerics::blas::Syrk<float> ssyrk_;
latsch::numerics::blas::Syrk<double> dsyrk_;
latsch::numerics::blas::Gemm<float> sgemm_;
latsch::numerics::blas::Gemm<double> dgemm_;
latsch::numerics::blas::Gemm<std::complex<double>> zgemm_;
latsch::numerics::blas::Trsv<float> strsv_;
latsch::numerics::blas::Trsv<double> dtrsv_;
latsch::numerics::blas::Gemv<float> sgemv_;
latsch::numerics::blas::Gemv<double> dgemv_;
}

namespace latsch::numerics {

constexpr auto* potrf(float) { return spotrf_; }
constexpr auto* potrf(double) { return dpotrf_; }
constexpr auto* trsm(float) { return strsm_; }
constexpr auto* trsm(double) { return dtrsm_; }
constexpr auto* syrk(float) { return ssyrk_; }
constexpr auto* syrk(double) { return dsyrk_; }
constexpr auto* gemm(float) { return sgemm_; }
constexpr auto* gemm(double) { return dgemm_; }
constexpr auto* gemm(std::complex<double>) { return zgemm_; }
constexpr auto* trsv(float) { return strsv_; }
constexpr auto* trsv(double) { return dtrsv_; }
constexpr auto* gemv(float) { return sgemv_; }
constexpr auto* gemv(double) { return dgemv_; }

}  // namespace latsch::numerics
