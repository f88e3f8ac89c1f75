// SPDX-License-Identifier: Apache-2.0
#include "numerics/dense/blas_core.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <vector>

extern "C" void dgemm_(const char* transa,
                       const char* transb,
                       const int* m,
                       const int* n,
                       const int* k,
                       const double* alpha,
                       const double* a,
                       const int* lda,
                       const double* b,
                       const int* ldb,
                       const double* beta,
                       double* c,
                       const int* ldc);

namespace latsch::numerics {
namespace {

/// Returns the seconds of the fastest of five products of 400 x 400 matrices.
double product_time() {
  constexpr int n = 400;
  const double one = 1.0, zero = 0.0;
  std::vector<double> a(n * n, 0.5), b(n * n, 0.25), c(n * n);
  double best = 1e9;
  for (int k = 0; k < 5; ++k) {
    const auto start = std::chrono::steady_clock::now();
    dgemm_("N", "N", &n, &n, &n, &one, a.data(), &n, b.data(), &n, &zero, c.data(), &n);
    best = std::min(
        best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  EXPECT_EQ(c[0], 0.125 * n);
  return best;
}

bool vectors_of_2013() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
  return false;
#endif
}

TEST(BlasCore, ReplacesAnOldFallbackAndIsFaster) {
  if (!vectors_of_2013())
    GTEST_SKIP() << "this processor has no AVX2: nothing better than the fallback to choose";
  if (std::getenv("OPENBLAS_CORETYPE"))
    GTEST_SKIP() << "OPENBLAS_CORETYPE is set: the user has chosen";
  choose_blas_core();
  const std::string chosen = blas_core();
  EXPECT_EQ(better_blas_core(chosen), "");
  ASSERT_TRUE(use_blas_core("Prescott"));  // the kernels for an unknown processor
  const double slow = product_time();
  const std::string better = better_blas_core("Prescott");
  ASSERT_TRUE(use_blas_core(better));
  EXPECT_EQ(blas_core(), better);
  EXPECT_LT(1.5 * product_time(), slow);
  ASSERT_TRUE(use_blas_core(chosen));
}

// Holds whichever libblas.so.3 and libopenblas.so.0 the system has.
TEST(BlasCore, IsOneOpenBlasWithoutThreads) {
  EXPECT_NE(blas_configuration().find("SINGLE_THREADED"), std::string::npos)
      << blas_configuration();
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    if (line.find("libopenblas") != std::string::npos) {
      EXPECT_NE(line.find("openblas-serial"), std::string::npos) << line;
    }
  }
}

}  // namespace
}  // namespace latsch::numerics
